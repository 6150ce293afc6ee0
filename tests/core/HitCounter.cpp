// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "HitCounter.h"
#include "grid/BlockGrid.h"

#include <map>
#include <stdexcept>

namespace akimap::test {

void HitCounter::check(const InsertionParameters&, double) const {
    if (!(weight_ > 0)) throw std::invalid_argument("weight: must be > 0");
}

bool HitCounter::insert(const Scan& scan, const InsertionParameters& p, BlockGrid& grid,
                        InsertionStats& stats) {
    const KeptRays kept = takeHits(scan.rays, p, grid, taken_, hits_, stats);
    std::map<uint64_t, std::vector<int>> cells;  // of each block
    for (const KeptRay& k : kept.hits) {
        const CellIndex c = grid.cellAt(k.ray->end[0], k.ray->end[1], k.ray->end[2]);
        cells[packKey(BlockGrid::blockOf(c))].push_back(BlockGrid::offsetOf(c));
    }
    std::vector<uint64_t> keys;
    for (const auto& [key, offsets] : cells) keys.push_back(key);
    const auto placeOf = [&](std::size_t b) { return unpackKey(keys[b]); };
    return update_.run(grid, keys.size(), placeOf, [&](std::size_t b, Block& block) {
        for (const int i : cells.at(keys[b])) block.alpha[static_cast<std::size_t>(i)] += weight_;
        return true;
    });
}

}  // namespace akimap::test
