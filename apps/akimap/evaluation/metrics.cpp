// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "evaluation/metrics.h"

#include <algorithm>
#include <limits>

namespace akimap::app {

namespace {

double ratio(double part, double whole) {
    return whole > 0 ? part / whole : std::numeric_limits<double>::quiet_NaN();
}

/** Mann and Whitney's U over the number of pairs; the cells are sorted by occupancy. */
double areaUnderRoc(const std::vector<ScoredCell>& sorted) {
    double free_below = 0, occupied = 0, won = 0;  // counts, exact in double up to 2^53
    for (std::size_t i = 0; i < sorted.size();) {
        double tied_occupied = 0, tied_free = 0;
        std::size_t j = i;
        for (; j < sorted.size() && sorted[j].occupancy == sorted[i].occupancy; j++)
            (sorted[j].occupied ? tied_occupied : tied_free)++;
        won += tied_occupied * (free_below + tied_free / 2);
        free_below += tied_free;
        occupied += tied_occupied;
        i = j;
    }
    return ratio(won, occupied * free_below);
}

ClassScores classScores(double right, double wrongly_claimed, double missed) {
    return {ratio(right, right + wrongly_claimed), ratio(right, right + missed),
            ratio(2 * right, 2 * right + wrongly_claimed + missed)};
}

}  // namespace

Scores score(std::vector<ScoredCell> cells) {
    double squares = 0, counts[2][2] = {};  // counts[said occupied][is occupied]
    for (const ScoredCell& c : cells) {
        const double error = c.occupancy - (c.occupied ? 1 : 0);
        squares += error * error;
        counts[c.occupancy > 0.5][c.occupied]++;
    }
    std::sort(cells.begin(), cells.end(),
              [](const ScoredCell& a, const ScoredCell& b) { return a.occupancy < b.occupancy; });
    return {cells.size(), areaUnderRoc(cells), ratio(squares, static_cast<double>(cells.size())),
            classScores(counts[1][1], counts[1][0], counts[0][1]),
            classScores(counts[0][0], counts[0][1], counts[1][0])};
}

}  // namespace akimap::app
