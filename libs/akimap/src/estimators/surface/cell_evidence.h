// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include "numeric/principal_axes.h"
#include "numeric/rows.h"

// From the sums of a cell to its alpha and beta (doc/design.md), for eight cells at a time.

namespace akimap {

// A cell is occupied where the surface lies from so far before its centre to so far behind [cells].
// The front is a little less than half a cell: a cell too many before a grazed floor stops rays
// half a metre early. Behind, it is what closes the holes between cells.
constexpr float kOccupiedFront = 0.45f;
constexpr float kOccupiedBehind = 2.5f;
constexpr float kPlaceError = 0.35f;  // [cells] of one scan's surface, standard deviation
constexpr float kMostAveraged = 4;    // scans, in that error: poses err together
constexpr float kSurfaceWeight = 2;   // a surface counts as much as so many free spaces
constexpr float kThroughWeight = 3;   // and rays that passed through as so many

/** S0, S1, S2 and f of eight cells: SurfaceSums. */
struct CellSumsRow {
    Row weight, place, square, through;
};
struct EvidenceRow {
    Row alpha, beta;
};

constexpr Row kOneRow = {1, 1, 1, 1, 1, 1, 1, 1};

/** The normal distribution function, to 3e-7 (Abramowitz and Stegun, 7.1.28). */
AKIMAP_INLINE Row normalDistribution(Row z) {
    constexpr float kRootHalf = 0.70710678f;
    const Row x = (Row)((RowMask)z & INT32_MAX) * kRootHalf;
    // Its powers less 1, which has fewer digits the nearer they are to 1.
    Row p =
        x *
        (0.0705230784f +
         x * (0.0422820123f +
              x * (0.0092705272f + x * (0.0001520143f + x * (0.0002765672f + x * 0.0000430638f)))));
    for (int i = 0; i < 4; i++) p *= 2.0f + p;
    const Row tail = 0.5f / (kOneRow + p);
    return z > 0.0f ? kOneRow - tail : tail;
}

/** The surface's distance from the cell's centre is normal, with the mean and the variance of what
 * was measured, and that of the mean's own error. */
AKIMAP_INLINE EvidenceRow evidenceOf(const CellSumsRow& s) {
    const Row per_weight = kOneRow / (s.weight > 1e-20f ? s.weight : kOneRow);
    const Row mean = s.place * per_weight, spread = s.square * per_weight - mean * mean;
    const Row least = s.weight > 1.0f ? s.weight : kOneRow,
              scans = least < kMostAveraged ? least : kMostAveraged * kOneRow;
    const Row variance = (spread > 0.0f ? spread : Row{}) + kPlaceError * kPlaceError / scans;
    const Row per_deviation = kOneRow / rootOf(variance);
    const Row not_before = normalDistribution((kOccupiedFront - mean) * per_deviation),
              behind = normalDistribution((-kOccupiedBehind - mean) * per_deviation),
              inside = not_before > behind ? not_before - behind : Row{};
    return {kSurfaceWeight * s.weight * inside,
            s.weight * (kOneRow - not_before) + kThroughWeight * s.through};
}

}  // namespace akimap
