// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <tbb/parallel_for.h>

#include <memory>
#include <new>
#include <utility>
#include <vector>

#include "grid/BlockGrid.h"

namespace akimap {

/** The one way in which a scan changes a grid: some blocks are reserved, owned or made, changed in
 * parallel, one task a block, and the new ones adopted. What may run out of memory comes before the
 * first sum is changed. Keeps its memory between scans. */
class BlockUpdate {
 public:
    /** \param n number of blocks, and \param placeOf(i) their places, each another
     * \param equip(i, Block&) gives block i what the update needs beside alpha and beta, without a
     * change of what they say; may throw. From several threads, in any order
     * \param update(i, Block&) adds the scan to block i and returns whether a cell of it gained
     * evidence. Likewise, in the caller's TBB arena; must not throw
     * \return whether any cell gained evidence
     * \exception std::bad_alloc with no sum changed */
    template <class PlaceOf, class Equip, class Update>
    bool run(BlockGrid& grid, std::size_t n, PlaceOf&& placeOf, Equip&& equip, Update&& update) {
        try {
            prepare(grid, n, placeOf, equip);
        } catch (...) {
            fresh_.clear();  // there is no memory to keep
            throw;
        }
        const auto updateOne = [&](std::size_t i) { gained_[i] = update(i, *blocks_[i]); };
        try {
            tbb::parallel_for(std::size_t{0}, n, updateOne);
        } catch (const std::bad_alloc&) {  // of a task: the rest goes without
            for (std::size_t i = 0; i < n; i++)
                if (gained_[i] == kPending) updateOne(i);
        }
        bool changed = false;
        for (std::size_t i = 0; i < n; i++) {
            if (!gained_[i]) continue;  // a bounding box can meet a block that its kernel misses
            changed = true;
            if (fresh_[i]) grid.adopt(placeOf(i), std::move(fresh_[i]));
        }
        fresh_.clear();
        return changed;
    }

    /** The same for estimators whose evidence is alpha and beta themselves: from then on these
     * follow from no surface. */
    template <class PlaceOf, class Update>
    bool run(BlockGrid& grid, std::size_t n, PlaceOf&& placeOf, Update&& update) {
        return run(
            grid, n, placeOf, [](std::size_t, Block&) {},
            [&](std::size_t i, Block& block) {
                block.surface.reset();
                return update(i, block);
            });
    }

 private:
    template <class PlaceOf, class Equip>
    void prepare(BlockGrid& grid, std::size_t n, PlaceOf& placeOf, Equip& equip) {
        blocks_.assign(n, nullptr);
        fresh_.assign(n, nullptr);
        gained_.assign(n, kPending);
        grid.reserve(grid.blockCount() + n);
        for (std::size_t i = 0; i < n; i++) blocks_[i] = grid.own(placeOf(i));
        tbb::parallel_for(std::size_t{0}, n, [&](std::size_t i) {
            if (!blocks_[i]) {
                fresh_[i] = std::make_shared<Block>();
                blocks_[i] = fresh_[i].get();
            }
            equip(i, *blocks_[i]);
        });
    }

    static constexpr char kPending = 2;
    std::vector<Block*> blocks_;
    std::vector<std::shared_ptr<Block>> fresh_;  // those that the grid does not have yet
    std::vector<char> gained_;                   // whether a cell of it did, or kPending
};

}  // namespace akimap
