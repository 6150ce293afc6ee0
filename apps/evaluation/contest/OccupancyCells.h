// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <akimap/AkiMap.h>
#include <octomap/OcTree.h>

#include <cmath>
#include <limits>

#include "evaluation/contest/SparseCells.h"
#include "evaluation/rivals/TsdfMap.h"

namespace akimap::app {

/** What a map says of its cells, whatever its class: the probability that one is occupied, NaN
 * where the map has no evidence. Made once of a map, because a ray then reads it fast: asking an
 * AkiMap cell by cell takes three times as long. */
using OccupancyCells = SparseCells<float>;

[[nodiscard]] inline OccupancyCells noCells(double resolution) {
    return OccupancyCells(resolution, std::numeric_limits<float>::quiet_NaN());
}
[[nodiscard]] inline bool isKnown(float occupancy) {
    return !std::isnan(occupancy);
}
/** The one threshold of all figures. */
[[nodiscard]] inline bool isOccupied(float occupancy) {
    return occupancy > 0.5f;  // NaN is not
}

[[nodiscard]] OccupancyCells cellsOf(const AkiMap& map);
/** Cell i covers [i, i + 1) * resolution, as in AkiMap. Expands the tree's pruned leaves. */
[[nodiscard]] OccupancyCells cellsOf(octomap::OcTree& tree);
[[nodiscard]] OccupancyCells cellsOf(const TsdfMap& map);

}  // namespace akimap::app
