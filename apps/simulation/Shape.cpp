// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "simulation/Shape.h"

#include <mrpt/poses/CPose3D.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace akimap::app {

using mrpt::math::TPoint3D;
using mrpt::math::TVector3D;

namespace {

constexpr double kMiss = std::numeric_limits<double>::infinity();

int countSteps(double length, double spacing) {
    return std::max(1, static_cast<int>(std::ceil(length / spacing)));
}

/** Middles of the fields of a grid over the parallelogram corner + [0,1] u + [0,1] v. */
void addGrid(std::vector<SurfacePoint>& out, const TPoint3D& corner, const TVector3D& u,
             const TVector3D& v, const TVector3D& normal, double spacing) {
    const int rows = countSteps(u.norm(), spacing), columns = countSteps(v.norm(), spacing);
    out.reserve(out.size() + static_cast<std::size_t>(rows * columns));
    for (int i = 0; i < rows; i++)
        for (int j = 0; j < columns; j++)
            out.push_back({corner + u * ((i + 0.5) / rows) + v * ((j + 0.5) / columns), normal});
}

/** Distance to the surface of a solid from its per-axis distances to the faces, where
 * negative means between them. */
double distanceFromAxes(const TVector3D& d) {
    const double inside = std::max({d.x, d.y, d.z});
    if (inside <= 0) return -inside;
    return TVector3D(std::max(d.x, 0.0), std::max(d.y, 0.0), std::max(d.z, 0.0)).norm();
}

class Room : public Shape {
 public:
    Room(const TPoint3D& low, const TPoint3D& high) : low_(low), high_(high) {}

    double rayDistance(const TPoint3D& o, const TVector3D& d) const override {
        double distance = d.z < 0 ? (low_.z - o.z) / d.z : kMiss;
        if (d.x != 0) distance = std::min(distance, ((d.x > 0 ? high_ : low_).x - o.x) / d.x);
        if (d.y != 0) distance = std::min(distance, ((d.y > 0 ? high_ : low_).y - o.y) / d.y);
        return o.z + distance * d.z <= high_.z ? distance : kMiss;  // else over the wall
    }
    double distanceTo(const TPoint3D& p) const override {
        double distance = kMiss;
        for (std::size_t axis = 0; axis < 3; axis++)
            for (const TPoint3D& side : {low_, high_}) {
                if (axis == 2 && side.z == high_.z) continue;  // no ceiling
                TPoint3D nearest;
                for (std::size_t i = 0; i < 3; i++)
                    nearest[i] = i == axis ? side[i] : std::clamp(p[i], low_[i], high_[i]);
                distance = std::min(distance, nearest.distanceTo(p));
            }
        return distance;
    }
    Ball ball() const override { return {(low_ + high_) * 0.5, kMiss}; }
    std::vector<SurfacePoint> surface(double spacing) const override {
        const TVector3D size = high_ - low_;
        const TVector3D x(size.x, 0, 0), y(0, size.y, 0), z(0, 0, size.z);
        std::vector<SurfacePoint> points;
        addGrid(points, low_, x, y, {0, 0, 1}, spacing);
        addGrid(points, low_, y, z, {1, 0, 0}, spacing);
        addGrid(points, low_, x, z, {0, 1, 0}, spacing);
        addGrid(points, low_ + x, y, z, {-1, 0, 0}, spacing);
        addGrid(points, low_ + y, x, z, {0, -1, 0}, spacing);
        return points;
    }

 private:
    TPoint3D low_, high_;
};

class Box : public Shape {
 public:
    Box(const mrpt::math::TPose3D& centre, const TVector3D& size)
        : centre_(centre.x, centre.y, centre.z), half_(size * 0.5) {
        const auto rotation = mrpt::poses::CPose3D(centre).getRotationMatrix();
        for (int i = 0; i < 3; i++)
            axes_[static_cast<std::size_t>(i)] = {rotation(0, i), rotation(1, i), rotation(2, i)};
    }

    double rayDistance(const TPoint3D& origin, const TVector3D& direction) const override {
        const TVector3D o = toLocal(origin - centre_), d = toLocal(direction);
        double enter = 0, leave = kMiss;
        for (std::size_t i = 0; i < 3; i++) {
            // A ray parallel to the faces divides by zero, and the infinities come out right.
            const double inverse = 1 / d[i];
            const double low = (-half_[i] - o[i]) * inverse, high = (half_[i] - o[i]) * inverse;
            enter = std::max(enter, std::min(low, high));
            leave = std::min(leave, std::max(low, high));
        }
        return enter > 0 && enter <= leave ? enter : kMiss;
    }
    double distanceTo(const TPoint3D& p) const override {
        const TVector3D v = toLocal(p - centre_);
        return distanceFromAxes(
            {std::abs(v.x) - half_.x, std::abs(v.y) - half_.y, std::abs(v.z) - half_.z});
    }
    Ball ball() const override { return {centre_, half_.norm()}; }
    std::vector<SurfacePoint> surface(double spacing) const override {
        std::vector<SurfacePoint> points;
        for (std::size_t i = 0; i < 3; i++)
            for (const double side : {-1.0, 1.0}) {
                const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
                const TVector3D u = axes_[j] * (2 * half_[j]), v = axes_[k] * (2 * half_[k]);
                const TVector3D normal = axes_[i] * side;
                const TPoint3D face = centre_ + normal * half_[i];
                addGrid(points, face - (u + v) * 0.5, u, v, normal, spacing);
            }
        return points;
    }

 private:
    [[nodiscard]] TVector3D toLocal(const TVector3D& v) const {
        return {dot(axes_[0], v), dot(axes_[1], v), dot(axes_[2], v)};
    }

    TPoint3D centre_;
    TVector3D half_;
    std::array<TVector3D, 3> axes_;
};

class Pillar : public Shape {
 public:
    Pillar(double x, double y, double radius, double bottom, double top)
        : x_(x), y_(y), radius_(radius), bottom_(bottom), top_(top) {}

    double rayDistance(const TPoint3D& o, const TVector3D& d) const override {
        const double ox = o.x - x_, oy = o.y - y_;
        const double a = d.x * d.x + d.y * d.y, b = ox * d.x + oy * d.y;
        const double c = ox * ox + oy * oy - radius_ * radius_;
        double distance = kMiss;
        if (const double root = b * b - a * c; a > 0 && root >= 0) {
            const double side = (-b - std::sqrt(root)) / a, z = o.z + side * d.z;
            if (side > 0 && z >= bottom_ && z <= top_) distance = side;
        }
        const double cap = ((d.z < 0 ? top_ : bottom_) - o.z) / d.z;
        const double cx = ox + cap * d.x, cy = oy + cap * d.y;
        if (cap > 0 && cx * cx + cy * cy <= radius_ * radius_) distance = std::min(distance, cap);
        return distance;
    }
    double distanceTo(const TPoint3D& p) const override {
        const double side = std::hypot(p.x - x_, p.y - y_) - radius_;
        const double cap = std::max(bottom_ - p.z, p.z - top_);
        return distanceFromAxes({side, cap, -kMiss});
    }
    Ball ball() const override {
        return {{x_, y_, 0.5 * (bottom_ + top_)}, std::hypot(radius_, 0.5 * (top_ - bottom_))};
    }
    std::vector<SurfacePoint> surface(double spacing) const override {
        std::vector<SurfacePoint> points;
        const int rings = countSteps(top_ - bottom_, spacing);
        forRing(radius_, spacing, [&](const TVector3D& outward) {
            for (int i = 0; i < rings; i++) {
                const double z = bottom_ + (top_ - bottom_) * (i + 0.5) / rings;
                const TPoint3D foot(x_, y_, z);
                points.push_back({foot + outward * radius_, outward});
            }
        });
        const int circles = countSteps(radius_, spacing);
        for (int i = 0; i < circles; i++) {
            const double r = radius_ * (i + 0.5) / circles;
            forRing(r, spacing, [&](const TVector3D& outward) {
                points.push_back({TPoint3D(x_, y_, top_) + outward * r, {0, 0, 1}});
                points.push_back({TPoint3D(x_, y_, bottom_) + outward * r, {0, 0, -1}});
            });
        }
        return points;
    }

 private:
    template <class Visitor>
    static void forRing(double radius, double spacing, Visitor&& visit) {
        const int steps = countSteps(2 * M_PI * radius, spacing);
        for (int i = 0; i < steps; i++) {
            const double angle = 2 * M_PI * i / steps;
            visit(TVector3D(std::cos(angle), std::sin(angle), 0));
        }
    }

    double x_, y_, radius_, bottom_, top_;
};

class Sphere : public Shape {
 public:
    Sphere(const TPoint3D& centre, double radius) : centre_(centre), radius_(radius) {}

    double rayDistance(const TPoint3D& origin, const TVector3D& direction) const override {
        const TVector3D o = origin - centre_;
        const double b = dot(o, direction), root = b * b - o.sqrNorm() + radius_ * radius_;
        if (root < 0) return kMiss;
        const double distance = -b - std::sqrt(root);
        return distance > 0 ? distance : kMiss;
    }
    double distanceTo(const TPoint3D& p) const override {
        return std::abs(p.distanceTo(centre_) - radius_);
    }
    Ball ball() const override { return {centre_, radius_}; }
    std::vector<SurfacePoint> surface(double spacing) const override {
        std::vector<SurfacePoint> points;
        const int rings = countSteps(M_PI * radius_, spacing);
        for (int i = 0; i < rings; i++) {
            const double polar = M_PI * (i + 0.5) / rings, sine = std::sin(polar);
            const int steps = countSteps(2 * M_PI * radius_ * sine, spacing);
            for (int j = 0; j < steps; j++) {
                const double angle = 2 * M_PI * j / steps;
                const TVector3D normal(sine * std::cos(angle), sine * std::sin(angle),
                                       std::cos(polar));
                points.push_back({centre_ + normal * radius_, normal});
            }
        }
        return points;
    }

 private:
    TPoint3D centre_;
    double radius_;
};

}  // namespace

ShapePtr makeRoom(const TPoint3D& low, const TPoint3D& high) {
    return std::make_shared<Room>(low, high);
}
ShapePtr makeBox(const mrpt::math::TPose3D& centre, const TVector3D& size) {
    return std::make_shared<Box>(centre, size);
}
ShapePtr makePillar(double x, double y, double radius, double bottom, double top) {
    return std::make_shared<Pillar>(x, y, radius, bottom, top);
}
ShapePtr makeSphere(const TPoint3D& centre, double radius) {
    return std::make_shared<Sphere>(centre, radius);
}

}  // namespace akimap::app
