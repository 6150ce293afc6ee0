// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "grid/BlockGrid.h"

namespace akimap::app {

/** A value for each cell of a grid, in blocks of 8 x 8 x 8 that appear when one of their cells is
 * written. Readers may read at the same time; a write must be alone. */
template <class T>
class SparseCells {
 public:
    /** \param resolution side of a cell [m] \param absent the value of cells never written */
    explicit SparseCells(double resolution, const T& absent = T())
        : grid_(resolution), absent_(absent) {}

    [[nodiscard]] double resolution() const { return grid_.resolution(); }  ///< [m]
    /** The cell that holds a point [m]. */
    [[nodiscard]] CellIndex cellAt(const std::array<double, 3>& p) const {
        return grid_.cellAt(p[0], p[1], p[2]);
    }
    /** Whether a point [m] has a cell and neighbours; false where it is not finite. */
    [[nodiscard]] bool covers(const std::array<double, 3>& p) const {
        return grid_.covers(p[0], p[1], p[2]);
    }

    /** To write to. */
    [[nodiscard]] T& operator[](const CellIndex& c) {
        const CellIndex place = BlockGrid::blockOf(c);
        if (!last_ || !(last_->place == place)) last_ = &blockAt(place);
        return last_->cells[offsetOf(c)];
    }

    /** Reads fast where one cell is near the one before. One for each thread. */
    class Reader {
     public:
        explicit Reader(const SparseCells& cells) : cells_(&cells) {}
        [[nodiscard]] const T& operator[](const CellIndex& c) {
            const CellIndex place = BlockGrid::blockOf(c);
            if (!is_looked_up_ || !(place_ == place)) {
                place_ = place;
                block_ = cells_->find(place);
                is_looked_up_ = true;
            }
            return block_ ? block_->cells[offsetOf(c)] : cells_->absent_;
        }

     private:
        const SparseCells* cells_;
        CellIndex place_;
        const typename SparseCells::Block* block_ = nullptr;
        bool is_looked_up_ = false;
    };

    /** Calls visit(CellIndex, const T&) for all cells of all blocks, written or not. */
    template <class Visitor>
    void forEach(Visitor&& visit) const {
        for (const auto& b : blocks_)
            for (int i = 0; i < kCells; i++)
                visit(CellIndex{b->place.x * 8 + (i & 7), b->place.y * 8 + (i >> 3 & 7),
                                b->place.z * 8 + (i >> 6)},
                      b->cells[static_cast<std::size_t>(i)]);
    }

 private:
    static constexpr int kCells = 512;
    struct Block {
        CellIndex place;
        std::array<T, kCells> cells;
    };

    static std::size_t offsetOf(const CellIndex& c) {
        return static_cast<std::size_t>(BlockGrid::offsetOf(c));
    }
    [[nodiscard]] const Block* find(const CellIndex& place) const {
        const uint32_t i = index_.find(packKey(place));
        return i == KeyTable::kNone ? nullptr : blocks_[i].get();
    }
    Block& blockAt(const CellIndex& place) {
        const auto [i, is_new] =
            index_.insert(packKey(place), static_cast<uint32_t>(blocks_.size()));
        if (is_new) {
            blocks_.push_back(std::make_unique<Block>());
            blocks_.back()->place = place;
            blocks_.back()->cells.fill(absent_);
        }
        return *blocks_[i];
    }

    BlockGrid grid_;  // holds nothing: it knows which cell a point lies in
    T absent_;
    KeyTable index_;
    std::vector<std::unique_ptr<Block>> blocks_;
    Block* last_ = nullptr;  // written to; blocks stay where they are
};

/** Calls visit(CellIndex) for a cell and its 26 neighbours until it returns true.
 * \return whether it did */
template <class Visitor>
bool anyWithinOneCell(const CellIndex& c, Visitor&& visit) {
    for (int32_t z = c.z - 1; z <= c.z + 1; z++)
        for (int32_t y = c.y - 1; y <= c.y + 1; y++)
            for (int32_t x = c.x - 1; x <= c.x + 1; x++)
                if (visit(CellIndex{x, y, z})) return true;
    return false;
}

}  // namespace akimap::app
