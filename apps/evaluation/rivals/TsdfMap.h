// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <akimap/Ray.h>

#include <optional>
#include <vector>

#include "evaluation/contest/SparseCells.h"

namespace akimap::app {

/** A plain truncated signed distance field (Curless and Levoy 1996), updated ray by ray: the mean,
 * in each cell, of how far the returns lay behind it along their rays. It counts no evidence, so
 * that its probabilities are but two, 0.9 and 0.1; it is here because no other map of these
 * predicts as well where the next scan's rays end.
 *
 * A ray adds min(L - t, T) to the cells it crosses, t [m] the way to the cell's centre along the
 * ray, L its length and T = 4 cells, up to T behind the return. The weight is 1 before the return
 * and falls to 0 at T behind it. */
class TsdfMap {
 public:
    /** \param resolution side of a cell [m] */
    explicit TsdfMap(double resolution) : cells_(resolution) {}

    [[nodiscard]] double resolution() const { return cells_.resolution(); }  ///< [m]
    /** \pre finite rays that have a length and lie in the grid (SparseCells::covers()) */
    void insert(const std::vector<Ray>& rays);

    /** [m] > 0 before a surface; empty where no ray has been. */
    [[nodiscard]] std::optional<double> distance(const CellIndex& cell) const;

    /** Calls visit(CellIndex, float occupancy) for each cell with evidence: 0.9 where the distance
     * lies between half a cell and -2 cells, else 0.1. */
    template <class Visitor>
    void forEachCell(Visitor&& visit) const {
        const double h = resolution();
        cells_.forEach([&](const CellIndex& c, const Cell& cell) {
            if (!(cell.weight > 0)) return;
            const double d = static_cast<double>(cell.sum) / static_cast<double>(cell.weight);
            visit(c, d <= 0.5 * h && d > -2 * h ? 0.9f : 0.1f);
        });
    }

 private:
    struct Cell {
        float sum = 0, weight = 0;
    };
    SparseCells<Cell> cells_;
};

}  // namespace akimap::app
