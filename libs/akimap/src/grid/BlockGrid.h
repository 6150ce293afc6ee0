// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "grid/KeyTable.h"

namespace akimap {

/** Index of a cell: cell i covers [i, i+1) * resolution on each axis. */
struct CellIndex {
    int32_t x = 0, y = 0, z = 0;
    bool operator==(const CellIndex& o) const { return x == o.x && y == o.y && z == o.z; }
};

/** The evidence of 8 x 8 x 8 cells: the sums of Eq. (2)-(3) without the prior, x running fastest;
 * a cell has evidence if either is positive. */
struct CellSums {
    static constexpr int kSide = 8;
    static constexpr int kCells = kSide * kSide * kSide;
    alignas(32) std::array<float, kCells> alpha;  // no initializers: Block() has zeros, and loading
    alignas(32) std::array<float, kCells> beta;   // a map need not write them first
};

/** Where surfaces were measured in a block, and how often it was seen through: what its alpha and
 * beta follow from (estimators/surface). */
struct SurfaceSums {
    alignas(32) std::array<float, CellSums::kCells> weight;   ///< observations of a surface, S0
    alignas(32) std::array<float, CellSums::kCells> place;    ///< S1 = sum of w d [cells]
    alignas(32) std::array<float, CellSums::kCells> square;   ///< S2 = sum of w d^2 [cells^2]
    alignas(32) std::array<float, CellSums::kCells> through;  ///< times that rays passed, f
};

struct Block : CellSums {
    std::unique_ptr<SurfaceSums> surface;  ///< null where no surface was near

    Block() = default;
    Block(const Block& o)
        : CellSums(o), surface(o.surface ? std::make_unique<SurfaceSums>(*o.surface) : nullptr) {}
    Block& operator=(const Block&) = delete;

    [[nodiscard]] static int offset(int x, int y, int z) { return (z * kSide + y) * kSide + x; }
    [[nodiscard]] bool hasEvidence(int i) const { return alpha[i] > 0 || beta[i] > 0; }
    [[nodiscard]] bool isEmpty() const;
};

/** No kernel may reach farther than this many cells from its sample. */
constexpr int32_t kMaxKernelCells = 256;

/** Sparse grid of the sums of Eq. (2)-(3): a hash of dense blocks. Copies share their blocks until
 * one of them writes.
 * Concurrent const calls are safe; a write must be alone on its grid, not among its copies. */
class BlockGrid {
 public:
    /** A block's place: its cells are [8 * index, 8 * index + 8) on each axis. */
    using BlockIndex = CellIndex;
    /** Points outside [-kMaxCell, kMaxCell] cells on any axis can't be inserted: keys have room
     * for 2^23, and the rest is for the kernels' reach. */
    static constexpr int32_t kMaxCell = (1 << 23) - kMaxKernelCells;

    explicit BlockGrid(double resolution);

    [[nodiscard]] double resolution() const { return resolution_; }  ///< [m]
    [[nodiscard]] bool isEmpty() const { return blocks_.empty(); }
    [[nodiscard]] std::size_t blockCount() const { return blocks_.size(); }
    [[nodiscard]] std::size_t countCells() const;  ///< cells with evidence; visits all
    /** Blocks, index and slack; blocks shared with a copy are counted in both. */
    [[nodiscard]] std::size_t memoryBytes() const;

    /** Whether the block's key is unique: 21 bits an axis. */
    [[nodiscard]] static bool isAddressable(const BlockIndex& b) {
        constexpr int32_t k = 1 << 20;
        const auto inside = [](int32_t v) { return v >= -k && v < k; };
        return inside(b.x) && inside(b.y) && inside(b.z);
    }
    /** Whether a point [m] can be inserted: false far out, and where it is not finite. */
    [[nodiscard]] bool covers(double x, double y, double z) const {
        return isWithin(kMaxCell, x, y, z);
    }
    /** Whether a point [m] has a cell: those that kernels reach from inserted points too. */
    [[nodiscard]] bool hasCell(double x, double y, double z) const {
        return isWithin(1 << 23, x, y, z);
    }
    [[nodiscard]] CellIndex cellAt(double x, double y, double z) const {
        return {axisIndex(x), axisIndex(y), axisIndex(z)};
    }
    [[nodiscard]] double center(int32_t i) const { return (i + 0.5) * resolution_; }  ///< [m]

    [[nodiscard]] inline const Block* find(const BlockIndex& b) const;
    /** The block to write to, this grid's own from now on; null if there is none. */
    [[nodiscard]] Block* own(const BlockIndex& b);
    /** Makes room for so many blocks in all: adopt() then allocates nothing. */
    void reserve(std::size_t blocks);
    /** \pre no block is there yet, and this one has evidence */
    void adopt(const BlockIndex& b, std::shared_ptr<Block> block);
    void clear();

    [[nodiscard]] static BlockIndex blockOf(const CellIndex& c) {
        return {c.x >> 3, c.y >> 3, c.z >> 3};
    }
    [[nodiscard]] static int offsetOf(const CellIndex& c) {
        return Block::offset(c.x & 7, c.y & 7, c.z & 7);
    }

    struct PlacedBlock {
        BlockIndex index;
        const Block* block;
    };
    /** All blocks in the defined order (z, then y, then x). */
    [[nodiscard]] std::vector<PlacedBlock> sortedBlocks() const;

    /** Calls visit(CellIndex, float alphaSum, float betaSum) for each cell with evidence,
     * in the order of sortedBlocks() and z, y, x within a block. */
    template <class Visitor>
    void forEachCell(Visitor&& visit) const {
        for (const PlacedBlock& b : sortedBlocks()) forEachCellOf(b.index, *b.block, visit);
    }

 private:
    struct Slot {
        uint64_t key;
        std::shared_ptr<Block> block;
    };

    template <class Visitor>
    static void forEachCellOf(const BlockIndex& b, const Block& block, Visitor& visit) {
        for (int i = 0; i < Block::kCells; i++)
            if (block.hasEvidence(i))
                visit(CellIndex{b.x * 8 + (i & 7), b.y * 8 + (i >> 3 & 7), b.z * 8 + (i >> 6)},
                      block.alpha[i], block.beta[i]);
    }
    [[nodiscard]] bool isWithin(int32_t cells, double x, double y, double z) const {
        const double limit = cells * resolution_;
        return std::abs(x) < limit && std::abs(y) < limit && std::abs(z) < limit;
    }
    [[nodiscard]] int32_t axisIndex(double v) const {
        const double cells = v / resolution_;
        const auto towards_zero = static_cast<int32_t>(cells);
        return towards_zero - (cells < towards_zero);  // std::floor() is slower
    }

    double resolution_;
    KeyTable index_;  // block key -> place in blocks_
    std::vector<Slot> blocks_;
};

/** 21 bits an axis, z highest: sorting keys sorts blocks by z, y, x. */
[[nodiscard]] inline uint64_t packKey(const CellIndex& c) {
    constexpr int64_t kBias = 1 << 20;
    constexpr uint64_t kMask = (1u << 21) - 1;
    return (static_cast<uint64_t>(c.z + kBias) & kMask) << 42 |
           (static_cast<uint64_t>(c.y + kBias) & kMask) << 21 |
           (static_cast<uint64_t>(c.x + kBias) & kMask);
}
inline const Block* BlockGrid::find(const BlockIndex& b) const {
    const uint32_t place = index_.find(packKey(b));
    return place == KeyTable::kNone ? nullptr : blocks_[place].block.get();
}
[[nodiscard]] inline CellIndex unpackKey(uint64_t key) {
    constexpr int64_t kBias = 1 << 20;
    constexpr uint64_t kMask = (1u << 21) - 1;
    const auto axis = [&](int shift) {
        return static_cast<int32_t>(static_cast<int64_t>(key >> shift & kMask) - kBias);
    };
    return {axis(0), axis(21), axis(42)};
}
/** The place in the map of a block whose key is relative to an anchor, a block's lowest cell. */
[[nodiscard]] inline BlockGrid::BlockIndex blockInMap(uint64_t key, const CellIndex& anchor) {
    const CellIndex b = unpackKey(key), a = BlockGrid::blockOf(anchor);
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}

}  // namespace akimap
