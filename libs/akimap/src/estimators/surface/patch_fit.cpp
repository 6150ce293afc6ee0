// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "estimators/surface/patch_fit.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "estimators/surface/ball_moments.h"
#include "numeric/principal_axes.h"

namespace akimap {
namespace {
constexpr double kFewestOfPlane = 5;   // points
constexpr double kFlat = 0.05;         // a plane's greatest ratio of its two lesser variances
constexpr double kLine = 0.005;        // a line's greatest ratio of its two greater variances
constexpr double kLeastCosine = 0.15;  // between a plane's normal and the ray that meets it: planes
                                       // through the sensor are of rings of its rays
constexpr double kLeastSine = 0.1;     // between a line and the ray that meets it
// Semi-axes of the ellipse.
constexpr double kWidth = 2;        // [standard deviations]
constexpr double kNarrowest = 0.8;  // [cells]
constexpr double kAlone = 1.2;      // [cells] where there is no plane
constexpr double kWidest = 0.24;    // [m] a wall ends somewhere, however sparse its returns

using Eigen::Vector3d;

/** Shapes one hit's patch after the other. Lengths in cells. */
class Shaper {
 public:
    explicit Shaper(double resolution)
        : per_cell_(1 / resolution), widest_(widestPatch(resolution) * per_cell_) {}

    /** \param variance in increasing order [m^2], about the mean, and \param axes theirs, in
     * columns \param back towards the sensor, of unit length \return where the hit belongs,
     * relative to itself [m] */
    Vector3d shape(const BallMoments& m, const Vector3d& variance, const Eigen::Matrix3d& axes,
                   const Vector3d& back, Patch& patch) const {
        if (m.n >= 3 && variance[1] < kLine * variance[2]) {
            const Vector3d line = axes.col(2);
            setEllipse(facing(back, line), line, semiAxis(variance[2], kAlone), kAlone, patch);
            return Vector3d::Zero();
        }
        const Vector3d normal = facingSensor(axes.col(0), back);
        if (m.n >= kFewestOfPlane && variance[0] < kFlat * variance[1] &&
            normal.dot(back) > kLeastCosine) {
            setEllipse(normal, axes.col(2), semiAxis(variance[2], kNarrowest),
                       semiAxis(variance[1], kNarrowest), patch);
            return normal * (normal.dot(Vector3d(m.x, m.y, m.z)) / m.w);
        }
        setEllipse(back, back.unitOrthogonal(), kAlone, kAlone, patch);
        return Vector3d::Zero();
    }

 private:
    [[nodiscard]] double semiAxis(double variance, double least) const {
        return std::clamp(kWidth * std::sqrt(variance) * per_cell_, least, widest_);
    }
    static Vector3d facingSensor(const Vector3d& normal, const Vector3d& back) {
        return normal.dot(back) < 0 ? Vector3d(-normal) : normal;
    }
    /** Hits along a line (a 2D scan, one ring of a lidar) lie on many planes: the one that faces
     * the sensor most. */
    static Vector3d facing(const Vector3d& back, const Vector3d& line) {
        const Vector3d across = back - line * line.dot(back);
        const double sine = across.norm();
        return sine < kLeastSine ? back : Vector3d(across / sine);
    }
    /** \param a its semi-axis next to `along`, \param b the other */
    static void setEllipse(const Vector3d& normal, const Vector3d& along, double a, double b,
                           Patch& patch) {
        Vector3d u = along - normal * normal.dot(along);
        const double length = u.norm();  // 0 where a ray runs along its line
        u = length > 1e-6 ? Vector3d(u / length) : normal.unitOrthogonal();
        const Vector3d v = normal.cross(u);
        for (int i = 0; i < 3; i++) {
            patch.normal[i] = static_cast<float>(normal[i]);
            patch.u[i] = static_cast<float>(u[i] / a), patch.v[i] = static_cast<float>(v[i] / b);
        }
    }

    double per_cell_, widest_;
};

Vector3d towardsSensor(const Ray& r) {
    return Vector3d(r.origin[0] - r.end[0], r.origin[1] - r.end[1], r.origin[2] - r.end[2])
        .normalized();
}

/** About the mean. */
AKIMAP_INLINE Symmetric3 covarianceOf(const BallMoments& m) {
    const double x = m.x / m.w, y = m.y / m.w, z = m.z / m.w,
                 unbiased = m.n / std::max(1.0, m.n - 1);
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

/** \param shift of the hit onto its patch [m] */
AKIMAP_INLINE void place(const Samples& hits, std::size_t i, double per_cell, const Vector3d& shift,
                         Patch& patch) {
    const double x = static_cast<double>(hits.x[i]), y = static_cast<double>(hits.y[i]),
                 z = static_cast<double>(hits.z[i]);
    const auto cell = [=](double v) { return static_cast<int32_t>(std::floor(v * per_cell)); };
    patch.cell = {cell(x), cell(y), cell(z)};
    patch.x = (x + shift[0]) * per_cell - 0.5;
    patch.y = (y + shift[1]) * per_cell - 0.5;
    patch.z = (z + shift[2]) * per_cell - 0.5;
}

AKIMAP_MULTIVERSION
void fitRange(const Shaper& shaper, const BallSearch& search, const std::vector<KeptRay>& rays,
              const Samples& hits, const std::vector<uint32_t>& order, std::size_t begin,
              std::size_t end, double per_cell, Patch* patches) {
    thread_local Neighbors near;
    BallMoments moments[kTogether];
    for (std::size_t first = begin, n; first < end; first += n) {  // along the curve
        const uint32_t* group = &order[first];
        n = search.together(group, end - first);
        search.moments(group, n, near, moments);
        const PrincipalAxes found = axesOf(moments, n);
        for (std::size_t k = 0; k < n; k++) {
            const uint32_t i = group[k];
            Vector3d variance;
            Eigen::Matrix3d axes;
            for (int a = 0; a < 3; a++) {
                variance[a] = std::max(0.0, static_cast<double>(found.value[a][k]));
                for (int c = 0; c < 3; c++) axes(c, a) = static_cast<double>(found.axis[a][c][k]);
            }
            Patch& patch = patches[i];
            const Vector3d back = towardsSensor(*rays[i].ray);
            place(hits, i, per_cell, shaper.shape(moments[k], variance, axes, back, patch), patch);
            patch.returns = static_cast<float>(rays[i].returns);
        }
    }
}

}  // namespace

double widestPatch(double resolution) {
    return std::max(kWidest, kAlone * resolution);
}

void fitPatches(const std::vector<KeptRay>& rays, const Samples& hits, const SurfaceParameters& p,
                double resolution, NeighborRows& rows, std::vector<Patch>& patches) {
    patches.resize(hits.size());
    rows.build(hits.x.data(), hits.y.data(), hits.z.data(), hits.size(), resolution);
    const Shaper shaper(resolution);
    const BallSearch search(hits, rows, std::max(p.surface_range, resolution), resolution);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, hits.size(), 64), [&](const auto& r) {
        fitRange(shaper, search, rays, hits, rows.order(), r.begin(), r.end(), 1 / resolution,
                 patches.data());
    });
}

}  // namespace akimap
