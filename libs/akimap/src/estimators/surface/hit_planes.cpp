// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "estimators/surface/hit_planes.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "estimators/surface/ball_moments.h"
#include "numeric/principal_axes.h"

namespace akimap {
namespace {
constexpr double kFewestOfPlane = 5;  // points
constexpr double kFlat = 0.05;        // a plane's greatest ratio of its two lesser variances
constexpr double kLine = 0.005;       // a line's greatest ratio of its two greater variances
constexpr double kLeastSine = 0.1;    // between a line and the ray that meets it
// Semi-axes of the ellipsoid. Half a cell's diagonal reaches a centre wherever the surface lies.
constexpr double kThinnest = 0.8660254037844386;  // [cells] across the surface
constexpr double kNoise = 0.5;                    // and so many standard deviations
constexpr double kWidth = 3.5;                    // [standard deviations] along it
constexpr double kNarrowest = 4;                  // [cells]
constexpr double kAlone = 2;                      // [cells] where there are too few neighbours
constexpr double kLineThinnest = 1.2;             // [cells] across the plane of a line

Symmetric3 symmetric(const Eigen::Matrix3d& m) {
    return {m(0, 0), m(0, 1), m(0, 2), m(1, 1), m(1, 2), m(2, 2)};
}

/** Fits one hit after the other. */
class Fitter {
 public:
    Fitter(const SurfaceParameters& p, double resolution)
        : resolution_(resolution),
          narrowest_(kNarrowest * resolution),
          widest_(widestKernel(p, resolution)) {}

    /** \param variance in increasing order, about the mean, and \param axes theirs, in columns
     * \param towards_sensor of unit length
     * \param shift where the hit belongs, relative to itself [m] */
    void fit(const BallMoments& m, const Eigen::Vector3d& variance, const Eigen::Matrix3d& axes,
             const Eigen::Vector3d& towards_sensor, HitPlane& plane, Symmetric3& H,
             Eigen::Vector3d& shift) const {
        plane = {{0, 0, 0}, false};
        shift.setZero();
        if (m.n < 3) {
            const double v = kAlone * kAlone * resolution_ * resolution_;
            H = {v, 0, 0, v, 0, v};
            return;
        }
        if (variance[1] < kLine * variance[2]) {
            plane = facing(towards_sensor, axes.col(2));
            H = alongLine(axes.col(2), squaredSemiAxes(variance)[2], plane);
            return;
        }
        if (m.n >= kFewestOfPlane && variance[0] < kFlat * variance[1]) {
            const Eigen::Vector3d normal = axes.col(0);
            shift = normal * (normal.dot(Eigen::Vector3d(m.x, m.y, m.z)) / m.w);
            plane = planeWith(normal);
        }
        H = symmetric(axes * squaredSemiAxes(variance).asDiagonal() * axes.transpose());
    }

 private:
    static HitPlane planeWith(const Eigen::Vector3d& n) {
        return {{static_cast<float>(n[0]), static_cast<float>(n[1]), static_cast<float>(n[2])},
                true};
    }
    /** Hits along a line (a 2D scan, one ring of a lidar) lie on many planes: the one that faces
     * the sensor most. */
    static HitPlane facing(const Eigen::Vector3d& towards_sensor, const Eigen::Vector3d& line) {
        const Eigen::Vector3d across = towards_sensor - line * line.dot(towards_sensor);
        const double sine = across.norm();
        return sine < kLeastSine ? HitPlane{{0, 0, 0}, false} : planeWith(across / sine);
    }
    /** The ellipsoid of a hit on a line: thin across the plane it was given, if any. */
    [[nodiscard]] Symmetric3 alongLine(const Eigen::Vector3d& line, double squared_length,
                                       const HitPlane& plane) const {
        const double wide = kAlone * resolution_, thin = kLineThinnest * resolution_;
        const Eigen::Vector3d n(plane.normal[0], plane.normal[1], plane.normal[2]);  // or 0
        return symmetric(wide * wide * Eigen::Matrix3d::Identity() +
                         (squared_length - wide * wide) * line * line.transpose() +
                         (thin * thin - wide * wide) * n * n.transpose());
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

    double resolution_, narrowest_, widest_;
};

Eigen::Vector3d towardsSensor(const Ray& r) {
    return Eigen::Vector3d(r.origin[0] - r.end[0], r.origin[1] - r.end[1], r.origin[2] - r.end[2])
        .normalized();
}

/** About the mean. */
AKIMAP_INLINE Symmetric3 covarianceOf(const BallMoments& m) {
    const double x = m.x / m.w, y = m.y / m.w, z = m.z / m.w, unbiased = (m.n - 1) / m.n;
    return {(m.m2.xx / m.w - x * x) * unbiased, (m.m2.xy / m.w - x * y) * unbiased,
            (m.m2.xz / m.w - x * z) * unbiased, (m.m2.yy / m.w - y * y) * unbiased,
            (m.m2.yz / m.w - y * z) * unbiased, (m.m2.zz / m.w - z * z) * unbiased};
}

/** Of the neighbours of n hits. */
AKIMAP_INLINE PrincipalAxes axesOf(const BallMoments* moments, std::size_t n) {
    static_assert(kTogether == 8);
    alignas(32) float m[6][kTogether] = {};
    for (std::size_t k = 0; k < n; k++) {
        const Symmetric3 c = covarianceOf(moments[k]);
        const double values[] = {c.xx, c.xy, c.xz, c.yy, c.yz, c.zz};
        for (std::size_t i = 0; i < 6; i++) m[i][k] = static_cast<float>(values[i]);
    }
    return principalAxes(
        {loadRow(m[0]), loadRow(m[1]), loadRow(m[2]), loadRow(m[3]), loadRow(m[4]), loadRow(m[5])});
}

AKIMAP_MULTIVERSION
void fitRange(const Fitter& fitter, const BallSearch& search, const std::vector<KeptRay>& rays,
              const HitPlaneWorkspace& s, std::size_t begin, std::size_t end, Samples& hits,
              HitPlane* planes, Symmetric3* H) {
    thread_local Neighbors near;
    BallMoments moments[kTogether];
    for (std::size_t place = begin, n; place < end; place += n) {  // along the curve
        const uint32_t* group = &s.rows.order()[place];
        n = search.together(group, end - place);
        search.moments(group, n, near, moments);
        const PrincipalAxes found = axesOf(moments, n);
        for (std::size_t k = 0; k < n; k++) {
            const uint32_t i = group[k];
            Eigen::Vector3d shift;
            Eigen::Vector3d variance;
            Eigen::Matrix3d axes;
            for (int a = 0; a < 3; a++) {
                variance[a] = std::max(0.0, static_cast<double>(found.value[a][k]));
                for (int c = 0; c < 3; c++) axes(c, a) = static_cast<double>(found.axis[a][c][k]);
            }
            fitter.fit(moments[k], variance, axes, towardsSensor(*rays[i].ray), planes[i], H[i],
                       shift);
            hits.x[i] += static_cast<float>(shift[0]);
            hits.y[i] += static_cast<float>(shift[1]);
            hits.z[i] += static_cast<float>(shift[2]);
        }
    }
}

}  // namespace

double widestKernel(const SurfaceParameters& p, double resolution) {
    return std::max(2 * p.surface_range, kNarrowest * resolution);
}

void fitHitPlanes(const std::vector<KeptRay>& rays, Samples& hits, const SurfaceParameters& p,
                  double resolution, HitPlaneWorkspace& scratch, std::vector<HitPlane>& planes,
                  std::vector<Symmetric3>& H) {
    planes.resize(hits.size());
    H.resize(hits.size());
    scratch.x = hits.x, scratch.y = hits.y, scratch.z = hits.z;  // as measured, while hits move
    scratch.rows.build(scratch.x.data(), scratch.y.data(), scratch.z.data(), hits.size(),
                       resolution);
    const Fitter fitter(p, resolution);
    const BallSearch search(scratch, std::max(p.surface_range, resolution), resolution);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, hits.size(), 64), [&](const auto& r) {
        fitRange(fitter, search, rays, scratch, r.begin(), r.end(), hits, planes.data(), H.data());
    });
}

}  // namespace akimap
