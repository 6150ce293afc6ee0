// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "pictures/MapCells.h"
#include "grid/BlockGrid.h"

#include <algorithm>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace akimap::app {

MapCells cellsOf(const AkiMap& map, double threshold) {
    constexpr int32_t kMin = std::numeric_limits<int32_t>::min(),
                      kMax = std::numeric_limits<int32_t>::max();
    MapCells cells{{}, {}, {kMax, kMax, kMax}, {kMin, kMin, kMin}};
    CellIndex &low = cells.lowest, &high = cells.highest;
    map.forEachCell([&](const Cell& cell) {
        const CellIndex c = indexOf(cell);
        (cell.state.occupancy() > threshold ? cells.occupied : cells.free).insert(c);
        low = {std::min(low.x, c.x), std::min(low.y, c.y), std::min(low.z, c.z)};
        high = {std::max(high.x, c.x), std::max(high.y, c.y), std::max(high.z, c.z)};
    });
    if (map.isEmpty()) low = high = {};
    return cells;
}

CellSet unknownCells(const MapCells& cells) {
    const CellIndex &low = cells.lowest, &high = cells.highest;
    const double inside = (high.x - low.x + 1.0) * (high.y - low.y + 1.0) * (high.z - low.z + 1.0);
    if (inside > kMaxUnknown) {
        std::ostringstream why;
        why << "--unknown: the map's bounds hold " << inside << " cells, more than the "
            << kMaxUnknown << " that can be drawn";
        throw std::runtime_error(why.str());
    }
    CellSet unknown;
    for (int32_t z = low.z; z <= high.z; z++)
        for (int32_t y = low.y; y <= high.y; y++)
            for (int32_t x = low.x; x <= high.x; x++)
                if (const CellIndex c{x, y, z};
                    !cells.occupied.contains(c) && !cells.free.contains(c))
                    unknown.insert(c);
    return unknown;
}

}  // namespace akimap::app
