// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <optional>

namespace akimap {

/** Evidence that every cell has before any scan, Eq. (2)-(3). */
struct Prior {
    double alpha, beta;
    bool operator==(const Prior& o) const { return alpha == o.alpha && beta == o.beta; }
};

/** The posterior of a cell, Eq. (2)-(4), prior included. */
struct CellState {
    double alpha = 0, beta = 0;
    [[nodiscard]] double occupancy() const { return alpha / (alpha + beta); }  ///< Eq. (4)
    [[nodiscard]] double variance() const {  ///< of the Beta distribution of the occupancy
        const double n = alpha + beta;
        return alpha * beta / (n * n * (n + 1));
    }
};

/** A cell with evidence: a cube of the map. */
struct Cell {
    double x, y, z;  ///< [m] its centre, map frame
    double size;     ///< [m] its side
    CellState state;
};

/** What is known of a cell. */
enum class CellKind {
    unknown,     ///< no evidence
    free,        ///< more than three times as much evidence for free as for occupied
    occupied,    ///< the other way round
    conflicting  ///< anything between
};
[[nodiscard]] CellKind kindOf(const std::optional<CellState>& cell);

/** Probability that the cell's occupancy exceeds the threshold: 1 - I_threshold(alpha, beta), the
 * regularized incomplete beta function.
 * \param threshold in (0, 1) \exception std::invalid_argument if it is not */
[[nodiscard]] double probabilityAbove(const CellState& cell, double threshold);

/** Of a place that has to be free: the probability that its cell's occupancy is below the
 * threshold; one half where nothing is known. */
[[nodiscard]] double confidenceInFree(const std::optional<CellState>& cell, double threshold);

}  // namespace akimap
