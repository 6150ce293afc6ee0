// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <akimap/Cell.h>

#include <optional>

#include "grid/BlockGrid.h"

namespace akimap {

/** A map as the queries see it: sums, and the prior that they are read with. */
struct MapView {
    const BlockGrid& grid;
    Prior prior;

    [[nodiscard]] CellState stateOf(float alpha_sum, float beta_sum) const {
        return {alpha_sum + prior.alpha, beta_sum + prior.beta};
    }
    /** The cell of this index; empty where nothing is known. */
    [[nodiscard]] std::optional<CellState> cell(const CellIndex& c) const {
        const Block* block = grid.find(BlockGrid::blockOf(c));
        const int i = BlockGrid::offsetOf(c);
        if (!block || !block->hasEvidence(i)) return std::nullopt;
        const auto at = static_cast<std::size_t>(i);
        return stateOf(block->alpha[at], block->beta[at]);
    }
    /** The cell that holds the point [m]; empty where nothing is known. */
    [[nodiscard]] std::optional<CellState> cell(double x, double y, double z) const {
        if (!grid.hasCell(x, y, z)) return std::nullopt;
        return cell(grid.cellAt(x, y, z));
    }
    /** How far the surface lies from the cell's centre, positive where the centre is on the side
     * that was seen [cells]; empty where no surface was measured near, or by an estimator that
     * keeps no distances. */
    [[nodiscard]] std::optional<double> surfaceDistance(const CellIndex& c) const {
        const Block* block = grid.find(BlockGrid::blockOf(c));
        return block ? surfaceDistanceIn(*block, BlockGrid::offsetOf(c)) : std::nullopt;
    }
    [[nodiscard]] static std::optional<double> surfaceDistanceIn(const Block& block, int i) {
        const auto at = static_cast<std::size_t>(i);
        if (!block.surface || !(block.surface->weight[at] > 0)) return std::nullopt;
        return static_cast<double>(block.surface->place[at] / block.surface->weight[at]);
    }
};

/** The surface passes through a cell whose centre is nearer: half a diagonal [cells]. Occupied
 * cells farther behind it are what keeps rays from slipping through. */
constexpr double kOnSurface = 0.87;

/** The one way to go over a map: calls visit(Cell) for each cell with evidence, in the grid's
 * order. */
template <class Visitor>
void forEachCell(const MapView& map, Visitor&& visit) {
    map.grid.forEachCell([&](const CellIndex& c, float alpha, float beta) {
        visit(Cell{map.grid.center(c.x), map.grid.center(c.y), map.grid.center(c.z),
                   map.grid.resolution(), map.stateOf(alpha, beta)});
    });
}

}  // namespace akimap
