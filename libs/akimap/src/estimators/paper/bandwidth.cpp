// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "estimators/paper/bandwidth.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <Eigen/Dense>

#include "estimators/paper/options.h"

namespace akimap {
namespace {

/** Eight samples, one in each lane, and the regions in which their neighbours are sought [m]. */
struct Group {
    Row x, y, z, range;
    bool box;       ///< regions are boxes, else balls
    Bounds bounds;  ///< holds all regions
};

/** Number and moments of the points in each lane's region, about its sample; that included. */
struct Moments {
    Row n{}, x{}, y{}, z{}, xx{}, xy{}, xz{}, yy{}, yz{}, zz{};
};

/** Squared distances r^2 in the metric of a covariance, or of one in each lane. */
template <class T>
struct Metric {
    T iz, y_z, iy, x_z, x_y, ix;

    AKIMAP_INLINE Row squaredDistance(Row dx, Row dy, Row dz) const {
        const Row ey = dy - y_z * dz, ex = dx - x_z * dz - x_y * ey;
        return dz * dz * iz + ey * ey * iy + ex * ex * ix;
    }
};

Metric<float> metricOf(const Ldlt& f) {
    return {static_cast<float>(1 / f.vz), static_cast<float>(f.y_z), static_cast<float>(1 / f.vy),
            static_cast<float>(f.x_z),    static_cast<float>(f.x_y), static_cast<float>(1 / f.vx)};
}

Metric<Row> metricsOf(const Symmetric3* covariances, int count) {
    Metric<Row> m{};
    for (int lane = 0; lane < count; lane++) {
        const Metric<float> one = metricOf(Ldlt(covariances[lane]));
        m.iz[lane] = one.iz, m.y_z[lane] = one.y_z, m.iy[lane] = one.iy;
        m.x_z[lane] = one.x_z, m.x_y[lane] = one.x_y, m.ix[lane] = one.ix;
    }
    return m;
}

Symmetric3 isotropic(double length) {
    const double v = length * length;
    return {v, 0, 0, v, 0, v};
}

AKIMAP_INLINE Row absolute(Row v) {
    return (Row)((RowMask)v & 0x7fffffff);
}

AKIMAP_INLINE Row larger(Row a, Row b) {
    return a > b ? a : b;
}

AKIMAP_INLINE RowMask isInside(Row dx, Row dy, Row dz, Row range, bool box) {
    return box ? larger(larger(absolute(dx), absolute(dy)), absolute(dz)) <= range
               : dx * dx + dy * dy + dz * dz <= range * range;
}

/** Calls visit(inside, dx, dy, dz) for each of these points, seen from the group's samples. */
template <class Visitor>
AKIMAP_INLINE void forEachPoint(const PointList& near, const Group& g, Visitor&& visit) {
    for (std::size_t i = 0; i < near.count; i++) {
        const Row dx = near.x[i] - g.x, dy = near.y[i] - g.y, dz = near.z[i] - g.z;
        visit(isInside(dx, dy, dz, g.range, g.box), dx, dy, dz);
    }
}

template <bool kFirst>  // whether first moments are wanted
AKIMAP_INLINE Moments momentsIn(const PointList& near, const Group& g) {
    constexpr Row one = {1, 1, 1, 1, 1, 1, 1, 1};
    Moments m;
    forEachPoint(near, g, [&](RowMask inside, Row dx, Row dy, Row dz) AKIMAP_INLINE_LAMBDA {
        dx = keep(inside, dx), dy = keep(inside, dy), dz = keep(inside, dz);
        m.n += keep(inside, one);
        if constexpr (kFirst) m.x += dx, m.y += dy, m.z += dz;
        m.xx += dx * dx, m.xy += dx * dy, m.xz += dx * dz;
        m.yy += dy * dy, m.yz += dy * dz, m.zz += dz * dz;
    });
    return m;
}

/** The lanes that have one of these points in their regions and supports u < limit. */
AKIMAP_INLINE RowMask lanesThatMeet(const PointList& near, const Group& g,
                                    const Metric<Row>& metric, float limit) {
    RowMask met{};
    forEachPoint(near, g, [&](RowMask inside, Row dx, Row dy, Row dz) AKIMAP_INLINE_LAMBDA {
        met |= inside & (metric.squaredDistance(dx, dy, dz) < limit);
    });
    return met;
}

/** Adds the points in a lane's region and support u < limit to the problem. */
AKIMAP_INLINE void addSupport(const PointList& near, const Group& g, int lane,
                              const Metric<float>& metric, float limit, bool positive,
                              SelectorWorkspace& scratch) {
    std::vector<float>& hits = scratch.hits;
    if (hits.size() < near.count + 8) hits.resize(2 * near.count + 8);
    std::size_t n = 0;
    for (std::size_t i = 0; i < near.count; i += 8) {
        const Row dx = loadRow(&near.x[i]) - g.x[lane], dy = loadRow(&near.y[i]) - g.y[lane],
                  dz = loadRow(&near.z[i]) - g.z[lane];
        const Row u = metric.squaredDistance(dx, dy, dz), range = Row{} + g.range[lane];
        const RowMask listed = kLaneIndex < static_cast<int32_t>(near.count - i);
        const uint32_t bits = bitsOf(listed & isInside(dx, dy, dz, range, g.box) & (u < limit));
        storeRow(&hits[n], packed(u, bits));
        n += static_cast<std::size_t>(__builtin_popcount(bits));
    }
    for (std::size_t i = 0; i < n; i++) scratch.problem.add(hits[i], positive);
}

/** First stage: the covariance of the neighbours of the same label, plus the floor. */
Symmetric3 covarianceOf(const Moments& m, int lane, const InsertionParameters& p,
                        double resolution) {
    const double n = m.n[lane], x = m.x[lane], y = m.y[lane], z = m.z[lane];
    if (n <= 2) return isotropic(resolution);
    const bool about_mean = p.covariance_center == CovarianceCenter::mean;
    const double k = about_mean ? 1 / n : 0, w = 1 / (about_mean ? n - 1 : n - 2);
    const double f = p.covariance_floor;
    return {(m.xx[lane] - k * x * x) * w + f, (m.xy[lane] - k * x * y) * w,
            (m.xz[lane] - k * x * z) * w,     (m.yy[lane] - k * y * y) * w + f,
            (m.yz[lane] - k * y * z) * w,     (m.zz[lane] - k * z * z) * w + f};
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

/** A label's samples: where they lie in Samples, and the points around them. */
struct Label {
    const NeighborRows &same, &other;
    std::size_t first;
};

/** Both stages, for one row of a label's samples after the other. */
class Selector {
 public:
    Selector(const Samples& s, const InsertionParameters& p, double resolution, const Label& label,
             SelectorWorkspace& scratch)
        : s_(s),
          p_(p),
          label_(label),
          resolution_(resolution),
          limit_(static_cast<float>(std::max(1.0, p.scale_max * p.scale_max))),
          scratch_(scratch) {}

    AKIMAP_INLINE void select(std::size_t row, Symmetric3* H) {
        const Group g = groupOf(row);
        label_.same.findPoints(g.bounds, scratch_.same);
        scratch_.tested += scratch_.same.count;
        const Moments m = p_.covariance_center == CovarianceCenter::mean
                              ? momentsIn<true>(scratch_.same, g)
                              : momentsIn<false>(scratch_.same, g);
        Symmetric3 own[NeighborRows::kRow];
        for (int lane = 0; lane < label_.same.countIn(row); lane++)
            own[lane] = covarianceOf(m, lane, p_, resolution_);
        if (p_.bandwidth == Bandwidth::adaptive) {
            label_.other.findPoints(g.bounds, scratch_.other);
            scratch_.tested += scratch_.other.count;
            if (scratch_.other.count) scale(g, m, label_.same.countIn(row), own);
        }
        for (int lane = 0; lane < label_.same.countIn(row); lane++)
            H[sampleAt(row, lane)] = own[lane];
    }

 private:
    [[nodiscard]] std::size_t sampleAt(std::size_t row, int lane) const {
        return label_.first +
               label_.same.order()[row * NeighborRows::kRow + static_cast<std::size_t>(lane)];
    }

    AKIMAP_INLINE Group groupOf(std::size_t row) const {
        const std::size_t i = row * NeighborRows::kRow;
        Group g{loadRow(label_.same.x() + i),          loadRow(label_.same.y() + i),
                loadRow(label_.same.z() + i),          Row{},
                p_.search_region == SearchRegion::box, label_.same.boundsOf(row)};
        float widest = 0;
        for (int lane = 0; lane < label_.same.countIn(row); lane++) {
            g.range[lane] = searchRange(p_, s_.distance[sampleAt(row, lane)]);
            widest = std::max(widest, g.range[lane]);
        }
        widest *= 1.0001f;  // rounding must not lose a point on a region's face
        for (int a = 0; a < 3; a++) g.bounds.low[a] -= widest, g.bounds.high[a] += widest;
        return g;
    }

    /** Second stage, for the samples whose kernels hold a point of the other label. */
    AKIMAP_INLINE void scale(const Group& g, const Moments& m, int count, Symmetric3* own) {
        const RowMask met = lanesThatMeet(scratch_.other, g, metricsOf(own, count), limit_);
        for (uint32_t bits = bitsOf(met & (m.n > 2.0f)); bits; bits &= bits - 1) {
            const int lane = __builtin_ctz(bits);
            const Metric<float> metric = metricOf(Ldlt(own[lane]));
            scratch_.problem.clear();
            addSupport(scratch_.other, g, lane, metric, limit_, false, scratch_);
            addSupport(scratch_.same, g, lane, metric, limit_, true, scratch_);
            own[lane] = scaled(own[lane], scaleOf(own[lane]));
        }
    }

    [[nodiscard]] double scaleOf(const Symmetric3& covariance) const {
        const double lowest = p_.scale_min_length / longestSemiAxis(covariance);
        if (p_.scale_search == ScaleSearch::descent)
            return scratch_.problem.descend(1 / std::sqrt(Ldlt(covariance).determinant()),
                                            std::min(lowest, 1.0));
        return scratch_.problem.minimise(std::min(lowest, p_.scale_max), p_.scale_max);
    }

    const Samples& s_;
    const InsertionParameters& p_;
    const Label& label_;
    double resolution_;
    float limit_;
    SelectorWorkspace& scratch_;
};

AKIMAP_MULTIVERSION
void selectRows(Selector& selector, std::size_t begin, std::size_t end, Symmetric3* H) {
    for (std::size_t row = begin; row < end; row++) selector.select(row, H);
}

void selectLabel(const Samples& s, const InsertionParameters& p, double resolution,
                 const Label& label, BandwidthWorkspace& scratch, std::vector<Symmetric3>& H) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, label.same.rows(), 32),
                      [&](const auto& r) {
                          Selector selector(s, p, resolution, label, scratch.per_thread.local());
                          selectRows(selector, r.begin(), r.end(), H.data());
                      });
}

}  // namespace

float searchRange(const InsertionParameters& p, float distance) {
    const double nearest = p.search_range_origin;
    return static_cast<float>(nearest + (p.search_range_max - nearest) * distance / p.max_range);
}

void bandwidths(const Samples& s, const InsertionParameters& given, double resolution,
                BandwidthWorkspace& scratch, std::vector<Symmetric3>& H) {
    InsertionParameters p = given;
    static_cast<PaperParameters&>(p) = paperInForce(given, resolution);
    H.resize(s.size());
    if (p.bandwidth == Bandwidth::isotropic) {
        std::fill(H.begin(), H.end(), isotropic(p.isotropic_length));
        return;
    }
    const std::size_t k = s.occupied;
    const float *x = s.x.data(), *y = s.y.data(), *z = s.z.data();
    tbb::parallel_invoke(
        [&] { scratch.occupied.build(x, y, z, k, resolution); },
        [&] { scratch.free.build(x + k, y + k, z + k, s.size() - k, resolution); });
    selectLabel(s, p, resolution, {scratch.occupied, scratch.free, 0}, scratch, H);
    selectLabel(s, p, resolution, {scratch.free, scratch.occupied, k}, scratch, H);
}

}  // namespace akimap
