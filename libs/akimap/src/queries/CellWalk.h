// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "grid/BlockGrid.h"

namespace akimap {

/** Steps from cell to cell along a ray (Amanatides and Woo 1987). */
class CellWalk {
 public:
    /** \param unit of length 1 */
    CellWalk(const BlockGrid& grid, const Eigen::Vector3d& origin, const Eigen::Vector3d& unit)
        : cell_(grid.cellAt(origin.x(), origin.y(), origin.z())) {
        for (int i = 0; i < 3; i++) {
            const auto a = static_cast<std::size_t>(i);
            const double o = origin[i], d = unit[i], r = grid.resolution();
            step_[a] = d > 0 ? 1 : -1;
            if (d == 0) continue;  // it never leaves that layer
            across_[a] = r / std::abs(d);
            next_[a] = ((index(a) + (d > 0 ? 1 : 0)) * r - o) / d;
        }
    }
    [[nodiscard]] const CellIndex& cell() const { return cell_; }
    [[nodiscard]] double entered() const { return entered_; }  ///< [m] from the origin
    [[nodiscard]] double left() const { return *std::min_element(next_.begin(), next_.end()); }
    void advance() {
        const auto axis =
            static_cast<std::size_t>(std::min_element(next_.begin(), next_.end()) - next_.begin());
        entered_ = next_[axis];
        next_[axis] += across_[axis];
        index(axis) += step_[axis];
    }

 private:
    int32_t& index(std::size_t axis) { return axis == 0 ? cell_.x : axis == 1 ? cell_.y : cell_.z; }
    static constexpr double kNever = std::numeric_limits<double>::infinity();
    CellIndex cell_;
    std::array<int32_t, 3> step_{};
    std::array<double, 3> next_{kNever, kNever, kNever}, across_{kNever, kNever, kNever};
    double entered_ = 0;
};

}  // namespace akimap
