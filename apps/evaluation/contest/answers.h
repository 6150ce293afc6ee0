// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "evaluation/contest/OccupancyCells.h"
#include "evaluation/evaluate.h"
#include "evaluation/holdout.h"

namespace akimap::app {

/** What several maps say to the same queries. */
struct Answers {
    std::vector<uint8_t> occupied;           ///< the truth of each query
    std::vector<std::vector<float>> of_map;  ///< for each map the occupancies; NaN: no evidence
};

/** Appends a map's answers. They do not depend on the number of threads. */
void ask(const OccupancyCells& map, const std::vector<Query>& queries, std::vector<float>& answers);

/** How a map fares over the queries that every map has evidence for, over those that it has
 * evidence for itself, and over all, with an occupancy of 0.5 where it has none. */
struct CellScores {
    Scores common, known, all;
    double coverage;  ///< known queries / all queries
};
/** For each map. */
[[nodiscard]] std::vector<CellScores> scoresOf(const Answers& answers);

/** The queries that a map knows, and all: for its curves. */
[[nodiscard]] ScoredCells scoredCells(const Answers& answers, std::size_t map);

}  // namespace akimap::app
