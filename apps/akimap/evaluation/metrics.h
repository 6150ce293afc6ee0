// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <cstddef>
#include <vector>

namespace akimap::app {

/** One judged cell: what the map says and what is true. */
struct ScoredCell {
    double occupancy;  ///< the map's probability that the cell is occupied
    bool occupied;     ///< the truth
};

/** How one class fares when a cell is called occupied above an occupancy of 0.5. */
struct ClassScores {
    double precision, recall, f1;  ///< in [0, 1]; NaN where it is 0 / 0
};

/** Accuracy over a set of cells. What can't be computed is NaN. */
struct Scores {
    std::size_t cells;
    double auc;  ///< area under the ROC curve; ties count 1/2; NaN if one class is missing
    double mse;  ///< mean of (occupancy - truth)^2
    ClassScores occupied, free;
};

/** O(n log n). Takes its argument by value because it sorts. */
[[nodiscard]] Scores score(std::vector<ScoredCell> cells);

}  // namespace akimap::app
