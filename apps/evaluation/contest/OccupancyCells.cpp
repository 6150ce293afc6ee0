// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "evaluation/contest/OccupancyCells.h"

namespace akimap::app {

OccupancyCells cellsOf(const AkiMap& map) {
    OccupancyCells cells = noCells(map.resolution());
    map.forEachCell([&](const Cell& c) {
        cells[map.grid().cellAt(c.x, c.y, c.z)] = static_cast<float>(c.state.occupancy());
    });
    return cells;
}

OccupancyCells cellsOf(octomap::OcTree& tree) {
    constexpr int32_t kCenter = 1 << 15;  // the key of the cell that begins at 0
    OccupancyCells cells = noCells(tree.getResolution());
    tree.expand();
    for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf) {
        const octomap::OcTreeKey key = leaf.getKey();
        cells[{key[0] - kCenter, key[1] - kCenter, key[2] - kCenter}] =
            static_cast<float>(leaf->getOccupancy());
    }
    return cells;
}

OccupancyCells cellsOf(const TsdfMap& map) {
    OccupancyCells cells = noCells(map.resolution());
    map.forEachCell([&](const CellIndex& c, float occupancy) { cells[c] = occupancy; });
    return cells;
}

}  // namespace akimap::app
