// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <map>
#include <tuple>
#include <vector>

#include "grid/BlockGrid.h"

namespace akimap::test {

/** The bits of the blocks at the places that `isWanted(BlockIndex)`. */
template <class Predicate>
auto blockBits(const BlockGrid& grid, Predicate&& isWanted) {
    std::map<std::tuple<int32_t, int32_t, int32_t>, std::vector<char>> bits;
    for (const auto& [b, block] : grid.sortedBlocks()) {
        if (!isWanted(b)) continue;
        auto& of = bits[{b.z, b.y, b.x}];
        const auto append = [&](const void* data, std::size_t size) {
            const auto* first = static_cast<const char*>(data);
            of.insert(of.end(), first, first + size);
        };
        append(static_cast<const CellSums*>(block), sizeof(CellSums));
        if (block->surface) append(block->surface.get(), sizeof(SurfaceSums));
    }
    return bits;
}
inline auto blockBits(const BlockGrid& grid) {
    return blockBits(grid, [](const BlockGrid::BlockIndex&) { return true; });
}

}  // namespace akimap::test
