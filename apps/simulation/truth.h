// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <octomap/OcTree.h>

#include <cstddef>
#include <memory>
#include <vector>

#include "simulation/FieldOfView.h"
#include "simulation/Scene.h"

namespace akimap::app {

/** What can be known of the scene from the views, without noise: cells cut by a visible surface
 * are occupied, cells without any surface crossed by a sight line that ends on a surface within
 * range are free, all else is unknown. A leaf per cell, clamped, not pruned.
 * \param resolution  side of a cell [m]
 * \exception std::runtime_error unless 0.01 <= resolution <= 1 */
std::unique_ptr<octomap::OcTree> visibleTruth(const Scene& scene, const std::vector<View>& views,
                                              double resolution);

struct TruthCounts {
    std::size_t occupied = 0, free = 0;  ///< cells of the tree's resolution
};
TruthCounts countCells(const octomap::OcTree& tree);

}  // namespace akimap::app
