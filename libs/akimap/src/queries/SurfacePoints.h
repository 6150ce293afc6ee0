// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "numeric/kd_tree.h"
#include "queries/MapView.h"

namespace akimap {

/** Where the surfaces are: a point [m] for each occupied cell (occupancy above 1/2), moved from the
 * cell's centre to where the evidence of the cells around it is, and the search for the nearest.
 * Concurrent const calls are safe. */
class SurfacePoints {
 public:
    using Point2 = std::array<float, 2>;  ///< [m]
    using Point3 = std::array<float, 3>;  ///< [m]

    explicit SurfacePoints(const MapView& map);
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
