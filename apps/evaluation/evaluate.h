// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <akimap/AkiMap.h>
#include <mrpt/maps/COctoMap.h>

#include <functional>
#include <optional>
#include <vector>

#include "evaluation/metrics.h"
#include "evaluation/truth.h"

namespace akimap::app {

/** Accuracy of a map against a truth. */
struct Evaluation {
    Scores known;     ///< over the cells that the map has evidence for
    Scores all;       ///< over every cell of known truth; without evidence the occupancy is 0.5
    double coverage;  ///< known cells / all cells
};

/** The cells that were judged, in the truth's order. */
struct ScoredCells {
    std::vector<ScoredCell> known;  ///< those that the map has evidence for
    std::vector<ScoredCell> all;    ///< and the others, with an occupancy of 0.5
};

/** What a map says of the cell at a centre (x, y, z) [m]; empty without evidence. */
using OccupancyLookup = std::function<std::optional<double>(double, double, double)>;

/** The map must outlive what is returned. */
[[nodiscard]] OccupancyLookup lookupIn(const AkiMap& map);
[[nodiscard]] OccupancyLookup lookupIn(const mrpt::maps::COctoMap& map);
[[nodiscard]] OccupancyLookup lookupIn(const octomap::OcTree& tree);

/** Looks up the cells of known truth whose centre lies in the box.
 * \param resolution the map's cell size [m]
 * \exception std::runtime_error if the truth's differs from it by more than 1e-6 of it, if there is
 * no cell to score, or more than kMaxScoredCells, or if an occupancy is not in [0, 1] */
[[nodiscard]] ScoredCells collect(const OccupancyLookup& lookup, double resolution,
                                  const Truth& truth, const Box& box = {});

/** Up to 48 bytes are needed for each; pruned leaves can stand for any number of cells. */
inline constexpr double kMaxScoredCells = 1e8;

/** Takes its argument by value because it sorts. */
[[nodiscard]] Evaluation score(ScoredCells cells);

/** collect(), then score(). */
[[nodiscard]] Evaluation evaluate(const OccupancyLookup& lookup, double resolution,
                                  const Truth& truth, const Box& box = {});
[[nodiscard]] Evaluation evaluate(const AkiMap& map, const Truth& truth, const Box& box = {});
[[nodiscard]] Evaluation evaluate(const mrpt::maps::COctoMap& map, const Truth& truth,
                                  const Box& box = {});

}  // namespace akimap::app
