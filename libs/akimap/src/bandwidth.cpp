// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "bandwidth.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <Eigen/Dense>

#include "scale.h"

namespace akimap {
namespace {

/** A point and the region around it in which neighbours are sought [m]. */
struct Region {
    float x, y, z, range;
    bool box;
};

/** Number and moments of the points in a region, about its centre; the centre itself included. */
struct Moments {
    double n = 0, x = 0, y = 0, z = 0;
    Symmetric3 m2;
};

/** Squared distances r^2 in the metric of a covariance, for rows of points. */
struct Metric {
    float iz, y_z, iy, x_z, x_y, ix;

    explicit Metric(const Factored& f)
        : iz(static_cast<float>(1 / f.vz)),
          y_z(static_cast<float>(f.y_z)),
          iy(static_cast<float>(1 / f.vy)),
          x_z(static_cast<float>(f.x_z)),
          x_y(static_cast<float>(f.x_y)),
          ix(static_cast<float>(1 / f.vx)) {}
    AKIMAP_INLINE Row squaredDistance(Row dx, Row dy, Row dz) const {
        const Row ey = dy - y_z * dz, ex = dx - x_z * dz - x_y * ey;
        return dz * dz * iz + ey * ey * iy + ex * ex * ix;
    }
};

Symmetric3 isotropic(double length) {
    const double v = length * length;
    return {v, 0, 0, v, 0, v};
}

AKIMAP_INLINE Row absolute(Row v) {
    return (Row)((RowMask)v & 0x7fffffff);
}

/** Calls visit(inside, dx, dy, dz) for rows of points that hold every point in the region. */
template <class Visitor>
AKIMAP_INLINE void forEachInRegion(const NeighborGrid& points, const Region& c, Visitor&& visit) {
    points.forEachRun(
        c.x, c.y, c.z, c.range, [&](uint32_t begin, uint32_t end) AKIMAP_INLINE_LAMBDA {
            for (uint32_t i = begin; i < end; i += 8) {
                const Row dx = loadRow(points.x() + i) - c.x, dy = loadRow(points.y() + i) - c.y,
                          dz = loadRow(points.z() + i) - c.z;
                const RowMask in_run = kLaneIndex < static_cast<int32_t>(end - i);
                const RowMask in_region =
                    c.box ? RowMask((absolute(dx) <= c.range) & (absolute(dy) <= c.range) &
                                    (absolute(dz) <= c.range))
                          : RowMask(dx * dx + dy * dy + dz * dz <= c.range * c.range);
                visit(RowMask(in_run & in_region), dx, dy, dz);
            }
        });
}

AKIMAP_INLINE Moments momentsIn(const NeighborGrid& points, const Region& c) {
    Row n{}, x{}, y{}, z{}, xx{}, xy{}, xz{}, yy{}, yz{}, zz{};
    constexpr Row one = {1, 1, 1, 1, 1, 1, 1, 1};
    forEachInRegion(points, c, [&](RowMask inside, Row dx, Row dy, Row dz) AKIMAP_INLINE_LAMBDA {
        dx = keep(inside, dx), dy = keep(inside, dy), dz = keep(inside, dz);
        n += keep(inside, one), x += dx, y += dy, z += dz;
        xx += dx * dx, xy += dx * dy, xz += dx * dz, yy += dy * dy, yz += dy * dz, zz += dz * dz;
    });
    return {sumOf(n),
            sumOf(x),
            sumOf(y),
            sumOf(z),
            {sumOf(xx), sumOf(xy), sumOf(xz), sumOf(yy), sumOf(yz), sumOf(zz)}};
}

/** Adds the points of the region with a squared distance u < limit to the problem. */
AKIMAP_INLINE void collectSupport(const NeighborGrid& points, const Region& c, const Metric& metric,
                                  float limit, bool positive, ScaleProblem& problem) {
    forEachInRegion(points, c, [&](RowMask inside, Row dx, Row dy, Row dz) AKIMAP_INLINE_LAMBDA {
        const Row u = metric.squaredDistance(dx, dy, dz);
        inside &= u < limit;
        for (int lane = 0; lane < 8; lane++)
            if (inside[lane]) problem.add(u[lane], positive);
    });
}

/** First stage: the covariance of the neighbours of the same label, plus the floor. */
Symmetric3 covarianceOf(const Moments& m, const InsertionParameters& p, double resolution) {
    if (m.n <= 2) return isotropic(resolution);
    const bool about_mean = p.covariance_center == CovarianceCenter::mean;
    const double k = about_mean ? 1 / m.n : 0, w = 1 / (about_mean ? m.n - 1 : m.n - 2);
    const double f = covarianceFloor(p, resolution);
    return {(m.m2.xx - k * m.x * m.x) * w + f, (m.m2.xy - k * m.x * m.y) * w,
            (m.m2.xz - k * m.x * m.z) * w,     (m.m2.yy - k * m.y * m.y) * w + f,
            (m.m2.yz - k * m.y * m.z) * w,     (m.m2.zz - k * m.z * m.z) * w + f};
}

double longestSemiAxis(const Symmetric3& h) {
    Eigen::Matrix3d m;
    m << h.xx, h.xy, h.xz, h.xy, h.yy, h.yz, h.xz, h.yz, h.zz;
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
    solver.computeDirect(m, Eigen::EigenvaluesOnly);
    return std::sqrt(solver.eigenvalues()[2]);
}

Symmetric3 scaled(const Symmetric3& h, double s) {
    const double f = s * s;
    return {h.xx * f, h.xy * f, h.xz * f, h.yy * f, h.yz * f, h.zz * f};
}

/** Both stages for samples of one label. */
class Selector {
 public:
    Selector(const NeighborGrid& same, const NeighborGrid& other, const InsertionParameters& p,
             double resolution)
        : same_(same), other_(other), p_(p), resolution_(resolution) {}

    AKIMAP_INLINE Symmetric3 select(const Region& region, ScaleProblem& problem) const {
        const Moments m = momentsIn(same_, region);
        const Symmetric3 covariance = covarianceOf(m, p_, resolution_);
        if (p_.bandwidth == Bandwidth::covariance || m.n <= 2) return covariance;

        const Factored factored(covariance);
        const Metric metric(factored);
        const float limit = static_cast<float>(std::max(1.0, p_.scale_max * p_.scale_max));
        problem.clear();
        collectSupport(other_, region, metric, limit, false, problem);
        if (problem.isEmpty()) return covariance;  // nothing that could push it back
        collectSupport(same_, region, metric, limit, true, problem);
        return scaled(covariance, scaleOf(covariance, factored, problem));
    }

 private:
    [[nodiscard]] double scaleOf(const Symmetric3& covariance, const Factored& factored,
                                 const ScaleProblem& problem) const {
        const double shortest = p_.scale_min_length > 0 ? p_.scale_min_length : resolution_;
        const double lowest = shortest / longestSemiAxis(covariance);
        if (p_.scale_search == ScaleSearch::descent)
            return problem.descend(1 / std::sqrt(factored.determinant()), std::min(lowest, 1.0));
        return problem.minimise(std::min(lowest, p_.scale_max), p_.scale_max);
    }

    const NeighborGrid &same_, &other_;
    const InsertionParameters& p_;
    double resolution_;
};

/** Where a label's samples lie in Samples, and how to select for them. */
struct LabelRange {
    const NeighborGrid& points;
    std::size_t first;
    Selector selector;
};

AKIMAP_MULTIVERSION
void selectRange(const Samples& s, const InsertionParameters& p, double resolution,
                 const LabelRange& label, std::size_t begin, std::size_t end, Symmetric3* H) {
    ScaleProblem problem;
    for (std::size_t place = begin; place < end; place++) {  // in bin order, for the cache
        const std::size_t i = label.first + label.points.order()[place];
        const Region region{s.x[i], s.y[i], s.z[i], searchRange(p, resolution, s.distance[i]),
                            p.search_region == SearchRegion::box};
        H[i] = label.selector.select(region, problem);
    }
}

void selectLabel(const Samples& s, const InsertionParameters& p, double resolution,
                 const LabelRange& label, std::vector<Symmetric3>& H) {
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, label.points.size(), 64),
        [&](const auto& r) { selectRange(s, p, resolution, label, r.begin(), r.end(), H.data()); });
}

}  // namespace

double covarianceFloor(const InsertionParameters& p, double resolution) {
    return p.covariance_floor > 0 ? p.covariance_floor : 0.4 * resolution * resolution;
}

float searchRange(const InsertionParameters& p, double resolution, float distance) {
    const double nearest = p.search_range_origin > 0 ? p.search_range_origin : resolution;
    return static_cast<float>(nearest + (p.search_range_max - nearest) * distance / p.max_range);
}

void bandwidths(const Samples& s, const InsertionParameters& p, double resolution,
                NeighborScratch& scratch, std::vector<Symmetric3>& H) {
    H.resize(s.size());
    if (p.bandwidth == Bandwidth::isotropic) {
        std::fill(H.begin(), H.end(), isotropic(p.isotropic_length));
        return;
    }
    const std::size_t k = s.occupied;
    const float bin = static_cast<float>(std::max(p.search_range_max, resolution) / 3);
    tbb::parallel_invoke(
        [&] { scratch.occupied.build(s.x.data(), s.y.data(), s.z.data(), k, bin); },
        [&] {
            scratch.free.build(s.x.data() + k, s.y.data() + k, s.z.data() + k, s.size() - k, bin);
        });
    selectLabel(s, p, resolution,
                {scratch.occupied, 0, {scratch.occupied, scratch.free, p, resolution}}, H);
    selectLabel(s, p, resolution,
                {scratch.free, k, {scratch.free, scratch.occupied, p, resolution}}, H);
}

}  // namespace akimap
