// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "grid/BlockGrid.h"
#include "numeric/distance_transform.h"

namespace akimap {

/** How far each cell lies from the balls of free space around one scan's rays: the power distance
 * min over balls of |cell - centre|^2 + R^2 - radius^2 [cells^2], the balls centred on cells and of
 * radius <= R; less than R^2 inside a ball. Two steps: mark() the balls, then transform(). As in
 * the distance transform of Felzenszwalb and Huttenlocher (2012) it is the least over x, then y,
 * then z; a block of 8^3 cells at a time, and only the blocks that a ball can reach. */
class FreeBalls {
 public:
    static constexpr int kMaxRadius = Block::kSide;  ///< [cells] R is at most this

    void clear();
    /** A ball around a cell. \param power R^2 - radius^2, >= 0 [cells^2 / kPowerUnit] */
    void mark(const CellIndex& cell, uint16_t power) {
        if (((cell.x ^ last_cell_.x) | (cell.y ^ last_cell_.y) | (cell.z ^ last_cell_.z)) >> 3)
            last_ = numberOf(packKey(BlockGrid::blockOf(cell))), last_cell_ = cell;
        uint16_t& here = blocks_[last_][static_cast<std::size_t>(BlockGrid::offsetOf(cell))];
        here = std::min(here, power);
    }
    /** Takes over the marks of another. */
    void merge(const FreeBalls& other);
    /** \param radius R [cells], in (0, kMaxRadius]. The same for any number of threads; runs in the
     * caller's TBB arena. */
    void transform(double radius);

    /** Blocks that a ball may reach, in order of first touch, and their power distances. */
    [[nodiscard]] const std::vector<uint64_t>& keys() const { return keys_; }
    [[nodiscard]] const PowerBlock& block(std::size_t i) const { return blocks_[i]; }
    /** Place of a block in keys(), KeyTable::kNone if it is not among them. */
    [[nodiscard]] uint32_t find(uint64_t key) const { return index_.find(key); }

 private:
    static constexpr CellIndex kNowhere = {INT32_MIN, 0, 0};
    uint32_t numberOf(uint64_t key);
    void growAlong(int axis, double radius);
    void transformAlong(int axis, int reach);

    KeyTable index_;
    std::vector<uint64_t> keys_;
    std::vector<PowerBlock> blocks_, transformed_;
    CellIndex last_cell_ = kNowhere;  // the last that was marked in another block than before
    uint32_t last_ = 0;
};

}  // namespace akimap
