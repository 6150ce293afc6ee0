// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <akimap/BlockGrid.h>
#include <mrpt/math/TPoint2D.h>
#include <mrpt/math/TPoint3D.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace akimap {

/** Evidence that every cell has before any sample, Eq. (2)-(3). */
struct Prior {
    double alpha, beta;
    bool operator==(const Prior& o) const { return alpha == o.alpha && beta == o.beta; }
};

/** Where the surfaces are: a point [m] for each occupied cell (occupancy above 1/2), moved from the
 * cell's centre to where the evidence of the cells around it is, and the search for the nearest.
 * Concurrent const calls are safe. */
class SurfacePoints {
 public:
    using Point2 = mrpt::math::TPoint2Df;
    using Point3 = mrpt::math::TPoint3Df;
    struct Neighbor {
        uint32_t index;      ///< of the point
        float sqr_distance;  ///< [m^2]
    };

    SurfacePoints(const BlockGrid& grid, const Prior& prior);
    ~SurfacePoints();
    SurfacePoints(const SurfacePoints&) = delete;
    SurfacePoints& operator=(const SurfacePoints&) = delete;

    [[nodiscard]] std::size_t size() const { return x_.size(); }
    [[nodiscard]] const std::vector<float>& x() const { return x_; }
    [[nodiscard]] const std::vector<float>& y() const { return y_; }
    [[nodiscard]] const std::vector<float>& z() const { return z_; }
    [[nodiscard]] Point3 operator[](std::size_t i) const { return {x_[i], y_[i], z_[i]}; }

    /** Empty if there are no points or the query is not finite. Seen from above for 2D queries. */
    [[nodiscard]] std::optional<Neighbor> nearest(const Point3& p) const;
    [[nodiscard]] std::optional<Neighbor> nearest(const Point2& p) const;
    /** At most `count` points nearer than the distance, the nearest first. */
    [[nodiscard]] std::vector<Neighbor> nearest(const Point3& p, std::size_t count,
                                                float max_sqr_distance) const;
    [[nodiscard]] std::vector<Neighbor> nearest(const Point2& p, std::size_t count,
                                                float max_sqr_distance) const;
    /** Makes the search trees, which the first search would make. */
    void prepare2D() const;
    void prepare3D() const;

 private:
    template <int kDimensions>
    struct Tree;
    [[nodiscard]] const Tree<2>& tree2() const;
    [[nodiscard]] const Tree<3>& tree3() const;

    std::vector<float> x_, y_, z_;
    struct Trees;
    std::unique_ptr<Trees> trees_;
};

}  // namespace akimap
