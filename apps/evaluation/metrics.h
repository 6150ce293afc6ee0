// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <array>
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
    double mse;  ///< mean of (occupancy - truth)^2: the Brier score
    ClassScores occupied, free;
    double log_loss;           ///< mean of -ln(p of what is true), p clamped to [0.01, 0.99]
    double calibration_error;  ///< calibrationError() of reliability()
};

/** O(n log n). Takes its argument by value because it sorts. */
[[nodiscard]] Scores score(std::vector<ScoredCell> cells);

/** The share of the free and of the occupied cells that lie above a threshold of occupancy. */
struct RocPoint {
    double false_positive_rate, true_positive_rate;
};

/** The ROC curve from (0, 0) to (1, 1), ties as one step; empty if one class is missing. Beyond
 * 1000 points it is thinned to at most 1001, which leaves out no detail as large as 0.004.
 * O(n log n). Takes its argument by value because it sorts. */
[[nodiscard]] std::vector<RocPoint> roc(std::vector<ScoredCell> cells);

/** The cells whose occupancy lies in one tenth of [0, 1]. */
struct ReliabilityBin {
    std::size_t cells = 0;
    double mean_occupancy = 0;     ///< NaN without cells
    double occupied_fraction = 0;  ///< share of them that are truly occupied; NaN without cells
};
using Reliability = std::array<ReliabilityBin, 10>;

/** Bin i holds occupancies in [i / 10, (i + 1) / 10), the last one 1 too. */
[[nodiscard]] Reliability reliability(const std::vector<ScoredCell>& cells);

/** Expected calibration error: the mean of |mean occupancy - occupied fraction| over the bins, each
 * weighted by its cells (Naeini et al. 2015, for the probability of "occupied"). NaN without cells.
 */
[[nodiscard]] double calibrationError(const Reliability& bins);

}  // namespace akimap::app
