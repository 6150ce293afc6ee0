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

/** How the rays through a block are marked. */
enum class Marking : uint8_t {
    steps,   ///< with balls and passes at places some way apart
    passes,  ///< with balls there, and passes cell by cell: balls reach other blocks, which may not
             ///< depend on what the map holds in this one
    cells    ///< with balls and passes cell by cell
};

/** How far each cell lies from the balls of free space around one scan's rays: the power distance
 * min over balls of |cell - centre|^2 + R^2 - radius^2 [cells^2], the balls centred on cells and of
 * radius <= R; less than R^2 inside a ball. Two steps: mark() the balls, then transform(). As in
 * the distance transform of Felzenszwalb and Huttenlocher (2012) it is the least over x, then y,
 * then z; a block of 8^3 cells at a time, and only the blocks that a ball can reach. */
class FreeBalls {
 public:
    using PassesBlock = std::array<uint8_t, Block::kCells>;
    static constexpr unsigned kMostPasses = 255;
    static constexpr int kMaxRadius = Block::kSide;  ///< [cells] R is at most this

    void clear();
    /** The number of a block, by which its cells are marked; made at the first call, when
     * \param marking(key) says how its rays are to be marked. */
    template <class MarkingOf>
    uint32_t numberOf(uint64_t key, MarkingOf&& marking) {
        if (key == last_key_) return last_;
        const auto known = static_cast<uint32_t>(keys_.size());
        last_ = numberOf(key), last_key_ = key;
        if (last_ == known) markings_[last_] = marking(key);
        return last_;
    }
    [[nodiscard]] Marking markingOf(uint32_t block) const { return markings_[block]; }
    /** Of one block; until the next call of numberOf(). */
    struct Marks {
        PowerBlock& power;
        PassesBlock& passes;
        /** A ball around a cell. \param p R^2 - radius^2, >= 0 [cells^2 / kPowerUnit] */
        void ball(int cell, uint16_t p) {
            uint16_t& here = power[static_cast<std::size_t>(cell)];
            here = std::min(here, p);
        }
        /** So many rays passed through the cell, far from their own hits. */
        void pass(int cell, unsigned rays) {
            uint8_t& passed = passes[static_cast<std::size_t>(cell)];
            passed = static_cast<uint8_t>(std::min(kMostPasses, passed + rays));
        }
    };
    [[nodiscard]] Marks marksOf(uint32_t block) {
        marks_++;
        return {blocks_[block], passes_[block]};
    }
    [[nodiscard]] std::size_t marks() const { return marks_; }
    /** Takes over the marks of another. */
    void merge(const FreeBalls& other);
    /** \param radius R [cells], in (0, kMaxRadius]. The same for any number of threads; runs in the
     * caller's TBB arena. */
    void transform(double radius);

    /** Blocks that a ball may reach, in order of first touch, and their power distances. */
    [[nodiscard]] const std::vector<uint64_t>& keys() const { return keys_; }
    [[nodiscard]] const PowerBlock& block(std::size_t i) const { return blocks_[i]; }
    /** How many rays passed through each cell, at most kMostPasses. */
    [[nodiscard]] const PassesBlock& passes(std::size_t i) const { return passes_[i]; }
    /** Place of a block in keys(), KeyTable::kNone if it is not among them. */
    [[nodiscard]] uint32_t find(uint64_t key) const { return index_.find(key); }

 private:
    static constexpr uint64_t kNoKey = ~uint64_t{0};
    uint32_t numberOf(uint64_t key);
    void growAlong(int axis, double radius);
    void transformAlong(int axis, int reach);

    KeyTable index_;
    std::vector<uint64_t> keys_;
    std::vector<PowerBlock> blocks_, transformed_;
    std::vector<PassesBlock> passes_;
    std::vector<Marking> markings_;
    std::size_t marks_ = 0;
    uint64_t last_key_ = kNoKey;  // of the block that was asked for last, and
    uint32_t last_ = 0;           // its number
};

}  // namespace akimap
