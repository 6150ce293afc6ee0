// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

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

}  // namespace akimap
