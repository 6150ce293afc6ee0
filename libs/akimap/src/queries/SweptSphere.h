// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

#include "grid/BlockGrid.h"

namespace akimap {

/** The cells that a sphere touches on its way along straight pieces. */
class SweptSphere {
 public:
    /** \param radius [m] >= 0 */
    SweptSphere(const BlockGrid& grid, double radius) : grid_(grid), radius_(radius) {}

    /** Calls visit(CellIndex, centre [m]) for each cell that the sphere touches, piece by piece in
     * the path's order; cells come again where pieces meet. \param path at least one place */
    template <class Visitor>
    void forEachCell(const std::vector<Eigen::Vector3d>& path, Visitor&& visit) const {
        along(path.front(), path.front(), visit);
        for (std::size_t i = 1; i < path.size(); i++) {
            const Eigen::Vector3d way =
                path[i] - path[i - 1];  // in steps, so that boxes stay small
            const double steps = std::ceil(way.norm() / std::max(radius_, 4 * grid_.resolution()));
            for (double k = 0; k < steps; k++)
                along(path[i - 1] + way * (k / steps), path[i - 1] + way * ((k + 1) / steps),
                      visit);
        }
    }

 private:
    template <class Visitor>
    void along(const Eigen::Vector3d& a, const Eigen::Vector3d& b, Visitor& visit) const {
        // A cell is touched if its own sphere is: half a diagonal more than enough, never too
        // little.
        const double reach = radius_ + std::sqrt(0.75) * grid_.resolution();
        const Eigen::Vector3d least = a.cwiseMin(b).array() - radius_,
                              most = a.cwiseMax(b).array() + radius_;
        const CellIndex low = grid_.cellAt(least.x(), least.y(), least.z()),
                        high = grid_.cellAt(most.x(), most.y(), most.z());
        for (int32_t z = low.z; z <= high.z; z++)
            for (int32_t y = low.y; y <= high.y; y++)
                for (int32_t x = low.x; x <= high.x; x++) {
                    const Eigen::Vector3d center(grid_.center(x), grid_.center(y), grid_.center(z));
                    if (distanceToPiece(center, a, b) <= reach) visit(CellIndex{x, y, z}, center);
                }
    }
    static double distanceToPiece(const Eigen::Vector3d& p, const Eigen::Vector3d& a,
                                  const Eigen::Vector3d& b) {
        const Eigen::Vector3d way = b - a;
        const double length2 = way.squaredNorm();
        const double t = length2 > 0 ? std::clamp((p - a).dot(way) / length2, 0.0, 1.0) : 0;
        return (p - (a + way * t)).norm();
    }

    const BlockGrid& grid_;
    double radius_;
};

}  // namespace akimap
