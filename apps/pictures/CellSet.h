// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <akimap/Cell.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "grid/BlockGrid.h"

namespace akimap::app {

/** The cell's place in a grid of its own size. */
[[nodiscard]] inline CellIndex indexOf(const Cell& c) {
    const auto along = [&](double v) { return static_cast<int32_t>(std::floor(v / c.size)); };
    return {along(c.x), along(c.y), along(c.z)};
}

/** A set of cells, one bit each: for drawing, where neighbours are asked for all the time. */
class CellSet {
 public:
    void insert(const CellIndex& c) {
        const auto place = static_cast<uint32_t>(blocks_.size());
        const auto [block, fresh] = index_.insert(packKey(BlockGrid::blockOf(c)), place);
        if (fresh) blocks_.push_back({BlockGrid::blockOf(c), {}});
        uint64_t& layer = blocks_[block].layers[static_cast<std::size_t>(c.z & 7)];
        if (!(layer & bit(c))) count_++;
        layer |= bit(c);
    }
    [[nodiscard]] bool contains(const CellIndex& c) const {
        const uint32_t block = index_.find(packKey(BlockGrid::blockOf(c)));
        return block != KeyTable::kNone &&
               (blocks_[block].layers[static_cast<std::size_t>(c.z & 7)] & bit(c));
    }
    [[nodiscard]] std::size_t size() const { return count_; }

    template <class Visitor>
    void forEach(Visitor&& visit) const {
        for (const BlockBits& b : blocks_)
            for (int i = 0; i < Block::kCells; i++)
                if (b.layers[static_cast<std::size_t>(i >> 6)] >> (i & 63) & 1)
                    visit(CellIndex{b.at.x * 8 + (i & 7), b.at.y * 8 + (i >> 3 & 7),
                                    b.at.z * 8 + (i >> 6)});
    }

 private:
    struct BlockBits {
        CellIndex at;
        std::array<uint64_t, Block::kSide> layers;  // by z; bits by y, then x
    };
    static_assert(Block::kSide == 8, "a layer is a word");
    static uint64_t bit(const CellIndex& c) { return uint64_t{1} << ((c.y & 7) << 3 | (c.x & 7)); }

    KeyTable index_;
    std::vector<BlockBits> blocks_;
    std::size_t count_ = 0;
};

}  // namespace akimap::app
