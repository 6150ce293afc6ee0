// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "surfels.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <Eigen/Dense>

namespace akimap {
namespace {
constexpr double kEnough = 10;        // neighbours, the hit included
constexpr double kSmallest = 2.5;     // [cells] radius of the first ball
constexpr double kGrowth = 1.3;       // from ball to ball
constexpr double kTaper = 0.5;        // neighbours at the ball's surface weigh 1 - kTaper
constexpr double kFewestOfPlane = 5;  // points
constexpr double kFlat = 0.1;         // a plane's greatest ratio of its two lesser variances
constexpr double kLine = 0.005;       // a line's greatest ratio of its two greater variances
constexpr double kLeastSine = 0.1;    // between a line and the ray that meets it
// Semi-axes of the ellipsoid. Half a cell's diagonal reaches a centre wherever the surface lies.
constexpr double kThinnest = 0.8660254037844386;  // [cells] across the surface
constexpr double kNoise = 0.5;                    // and so many standard deviations
constexpr double kWidth = 4;                      // [standard deviations] along it
constexpr double kNarrowest = 4;                  // [cells]
constexpr double kAlone = 2;                      // [cells] where there are too few neighbours

/** Weighted number and moments of the points in a ball, about its centre. */
struct BallMoments {
    double n = 0, w = 0, x = 0, y = 0, z = 0;
    Symmetric3 m2;
};

AKIMAP_INLINE BallMoments momentsIn(const PointList& points, float cx, float cy, float cz,
                                    float radius) {
    Row n{}, w{}, x{}, y{}, z{}, xx{}, xy{}, xz{}, yy{}, yz{}, zz{};
    constexpr Row one = {1, 1, 1, 1, 1, 1, 1, 1};
    const float limit = radius * radius, taper = static_cast<float>(kTaper) / limit;
    for (std::size_t i = 0; i < points.count; i += 8) {
        const Row dx = loadRow(&points.x[i]) - cx, dy = loadRow(&points.y[i]) - cy,
                  dz = loadRow(&points.z[i]) - cz, u = dx * dx + dy * dy + dz * dz;
        const RowMask inside = (kLaneIndex < static_cast<int32_t>(points.count - i)) & (u <= limit);
        const Row v = keep(inside, 1.0f - taper * u);
        const Row vx = v * dx, vy = v * dy, vz = v * dz;
        n += keep(inside, one), w += v, x += vx, y += vy, z += vz;
        xx += vx * dx, xy += vx * dy, xz += vx * dz, yy += vy * dy, yz += vy * dz, zz += vz * dz;
    }
    return {sumOf(n), sumOf(w), sumOf(x),
            sumOf(y), sumOf(z), {sumOf(xx), sumOf(xy), sumOf(xz), sumOf(yy), sumOf(yz), sumOf(zz)}};
}

Bounds boxOf(const SurfelScratch& s, uint32_t i, float r) {
    return {{s.x[i] - r, s.y[i] - r, s.z[i] - r}, {s.x[i] + r, s.y[i] + r, s.z[i] + r}};
}
void include(const Bounds& other, Bounds& all) {
    for (int a = 0; a < 3; a++) {
        all.low[a] = std::min(all.low[a], other.low[a]);
        all.high[a] = std::max(all.high[a], other.high[a]);
    }
}

constexpr std::size_t kTogether = 8;  // hits that share a search

/** What a search found: near all of some hits, and near one of them. */
struct Neighbors {
    PointList all, own;
};

Symmetric3 symmetric(const Eigen::Matrix3d& m) {
    return {m(0, 0), m(0, 1), m(0, 2), m(1, 1), m(1, 2), m(2, 2)};
}

/** Fits one hit after the other. */
class Fitter {
 public:
    Fitter(const NeighborRows& points, const InsertionParameters& p, double resolution)
        : points_(points),
          resolution_(resolution),
          range_(std::max(p.surface_range, resolution)),
          narrowest_(kNarrowest * resolution),
          widest_(widestSurfel(p, resolution)) {}

    /** Moments of the smallest ball around each of n hits that holds enough. The hits lie near each
     * other and share a search for all of their balls. */
    AKIMAP_INLINE void neighbors(const SurfelScratch& s, const uint32_t* hits, std::size_t n,
                                 Neighbors& near, BallMoments* moments) const {
        uint32_t pending = (1u << n) - 1;
        for (double radius = std::min(kSmallest * resolution_, range_);;
             radius = std::min(radius * kGrowth, range_)) {
            const auto r = static_cast<float>(radius);
            Bounds around = boxOf(s, hits[__builtin_ctz(pending)], r);
            for (uint32_t left = pending; left; left &= left - 1)
                include(boxOf(s, hits[__builtin_ctz(left)], r), around);
            points_.findPoints(around, near.all);
            for (uint32_t left = pending; left; left &= left - 1) {
                const int k = __builtin_ctz(left);
                const uint32_t i = hits[k];
                near.all.findPoints(boxOf(s, i, r), near.own);
                moments[k] = momentsIn(near.own, s.x[i], s.y[i], s.z[i], r);
                if (moments[k].n >= kEnough) pending &= ~(1u << k);
            }
            if (!pending || radius >= range_) return;
        }
    }

    /** How many hits from this place on, at most kTogether, lie near the first. */
    [[nodiscard]] std::size_t together(const SurfelScratch& s, const uint32_t* hits,
                                       std::size_t most) const {
        const Bounds near = boxOf(s, hits[0], static_cast<float>(2 * kSmallest * resolution_));
        std::size_t n = 1;
        const auto isNear = [&](uint32_t i) {
            return s.x[i] >= near.low[0] && s.x[i] <= near.high[0] && s.y[i] >= near.low[1] &&
                   s.y[i] <= near.high[1] && s.z[i] >= near.low[2] && s.z[i] <= near.high[2];
        };
        while (n < std::min(most, kTogether) && isNear(hits[n])) n++;
        return n;
    }

    /** \param towards_sensor of unit length
     * \param shift where the hit belongs, relative to itself [m] */
    void fit(const BallMoments& m, const Eigen::Vector3d& towards_sensor, Surfel& surfel,
             Symmetric3& H, Eigen::Vector3d& shift) const {
        surfel = {{0, 0, 0}, false};
        shift.setZero();
        if (m.n < 3) {
            const double v = kAlone * kAlone * resolution_ * resolution_;
            H = {v, 0, 0, v, 0, v};
            return;
        }
        const Eigen::Vector3d mean = Eigen::Vector3d(m.x, m.y, m.z) / m.w;
        Eigen::Matrix3d second;
        second << m.m2.xx, m.m2.xy, m.m2.xz, m.m2.xy, m.m2.yy, m.m2.yz, m.m2.xz, m.m2.yz, m.m2.zz;
        const Eigen::Matrix3d covariance =
            (second / m.w - mean * mean.transpose()) * (m.n - 1) / m.n;
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
        solver.computeDirect(covariance);
        const Eigen::Vector3d variance = solver.eigenvalues().cwiseMax(0);
        const Eigen::Matrix3d& axes = solver.eigenvectors();
        if (variance[1] < kLine * variance[2]) {
            surfel = facing(towards_sensor, axes.col(2));
            const double across = kAlone * resolution_;
            const Eigen::Vector3d tube(across * across, across * across,
                                       squaredSemiAxes(variance)[2]);
            H = symmetric(axes * tube.asDiagonal() * axes.transpose());
            return;
        }
        if (m.n >= kFewestOfPlane && variance[0] < kFlat * variance[1]) {
            const Eigen::Vector3d normal = axes.col(0);
            shift = normal * normal.dot(mean);
            surfel = flatSurfel(normal);
        }
        H = symmetric(axes * squaredSemiAxes(variance).asDiagonal() * axes.transpose());
    }

 private:
    static Surfel flatSurfel(const Eigen::Vector3d& n) {
        return {{static_cast<float>(n[0]), static_cast<float>(n[1]), static_cast<float>(n[2])},
                true};
    }
    /** Hits along a line (a 2D scan, one ring of a lidar) lie on many planes: the one that faces
     * the sensor most. */
    static Surfel facing(const Eigen::Vector3d& towards_sensor, const Eigen::Vector3d& line) {
        const Eigen::Vector3d across = towards_sensor - line * line.dot(towards_sensor);
        const double sine = across.norm();
        return sine < kLeastSine ? Surfel{{0, 0, 0}, false} : flatSurfel(across / sine);
    }
    /** Of the ellipsoid, for the variances in increasing order. */
    [[nodiscard]] Eigen::Vector3d squaredSemiAxes(const Eigen::Vector3d& variance) const {
        const double thinnest = kThinnest * resolution_;
        Eigen::Vector3d v;
        v[0] = thinnest * thinnest + kNoise * kNoise * variance[0];
        for (int i : {1, 2}) {
            const double length = std::clamp(kWidth * std::sqrt(variance[i]), narrowest_, widest_);
            v[i] = length * length;
        }
        return v;
    }

    const NeighborRows& points_;
    double resolution_, range_, narrowest_, widest_;
};

Eigen::Vector3d towardsSensor(const Ray& r) {
    return Eigen::Vector3d(r.origin[0] - r.end[0], r.origin[1] - r.end[1], r.origin[2] - r.end[2])
        .normalized();
}

AKIMAP_MULTIVERSION
void fitRange(const Fitter& fitter, const std::vector<KeptRay>& rays, const SurfelScratch& s,
              std::size_t begin, std::size_t end, Samples& hits, Surfel* surfels, Symmetric3* H) {
    thread_local Neighbors near;
    BallMoments moments[kTogether];
    for (std::size_t place = begin, n; place < end; place += n) {  // along the curve
        const uint32_t* group = &s.rows.order()[place];
        n = fitter.together(s, group, end - place);
        fitter.neighbors(s, group, n, near, moments);
        for (std::size_t k = 0; k < n; k++) {
            const uint32_t i = group[k];
            Eigen::Vector3d shift;
            fitter.fit(moments[k], towardsSensor(*rays[i].ray), surfels[i], H[i], shift);
            hits.x[i] += static_cast<float>(shift[0]);
            hits.y[i] += static_cast<float>(shift[1]);
            hits.z[i] += static_cast<float>(shift[2]);
        }
    }
}

}  // namespace

double widestSurfel(const InsertionParameters& p, double resolution) {
    return std::max(2 * p.surface_range, kNarrowest * resolution);
}

void fitSurfels(const std::vector<KeptRay>& rays, Samples& hits, const InsertionParameters& p,
                double resolution, SurfelScratch& scratch, std::vector<Surfel>& surfels,
                std::vector<Symmetric3>& H) {
    surfels.resize(hits.size());
    H.resize(hits.size());
    scratch.x = hits.x, scratch.y = hits.y, scratch.z = hits.z;  // as measured, while hits move
    scratch.rows.build(scratch.x.data(), scratch.y.data(), scratch.z.data(), hits.size(),
                       resolution);
    const Fitter fitter(scratch.rows, p, resolution);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, hits.size(), 64), [&](const auto& r) {
        fitRange(fitter, rays, scratch, r.begin(), r.end(), hits, surfels.data(), H.data());
    });
}

}  // namespace akimap
