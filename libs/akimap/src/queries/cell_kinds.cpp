// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <akimap/Cell.h>

#include <Eigen/Core>
#include <stdexcept>
#include <unsupported/Eigen/SpecialFunctions>

namespace akimap {

CellKind kindOf(const std::optional<CellState>& cell) {
    if (!cell) return CellKind::unknown;
    if (cell->alpha > 3 * cell->beta) return CellKind::occupied;
    if (cell->beta > 3 * cell->alpha) return CellKind::free;
    return CellKind::conflicting;
}

double probabilityAbove(const CellState& cell, double threshold) {
    if (!(threshold > 0 && threshold < 1))
        throw std::invalid_argument("threshold: must be in (0, 1)");
    return 1 - Eigen::numext::betainc(cell.alpha, cell.beta, threshold);
}

double confidenceInFree(const std::optional<CellState>& cell, double threshold) {
    return cell ? 1 - probabilityAbove(*cell, threshold) : 0.5;
}

}  // namespace akimap
