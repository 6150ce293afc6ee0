// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "evaluation/contest/answers.h"
#include "evaluation/contest/entrants.h"
#include "evaluation/contest/faithfulness.h"
#include "evaluation/contest/next_scan.h"

namespace akimap::app {

/** Gives a recording's scans in their order, each time it is called. */
using Recording = std::function<void(const std::function<void(const std::vector<Ray>&)>& take)>;
/** \param scans must outlive what is returned */
[[nodiscard]] Recording recordingOf(const std::vector<std::vector<Ray>>& scans);

struct ContestRules {
    double resolution = 0.05;    ///< [m] of the cells, the same for all entrants
    InsertionParameters ranges;  ///< whose range limits apply to the held-out scans too
    std::size_t every = 5;       ///< >= 2. Scans every, 2 every, ..., counted from 1, are held out
    bool all_folds = false;      ///< and then those one earlier, and so on: each scan once
    std::optional<std::size_t> view;  ///< the scan to keep for a picture, counted from 0; none: the
                                      ///< one in the middle of those held out first
};
/** With the map's cells and range limits. */
[[nodiscard]] ContestRules rulesFor(const AkiMap& configured);
/** Of a held-out scan, returns are cast and queried evenly, at most so many. */
inline constexpr std::size_t kMostReturns = 20000;

/** How one held-out scan's rays ended in a map. */
struct ScanShares {
    std::size_t scan;  ///< counted from 0
    RayShares shares;
};

/** All figures of one map, over all folds. */
struct MapResult {
    std::string name, what;
    bool sees_held_out = false;  ///< Entrant::sees_held_out
    RayTally rays;
    std::vector<ScanShares> by_scan;  ///< in the order judged; scans without rays are left out
    Faithfulness faithfulness;
    CellScores to_fixed_clearance;  ///< free places up to 0.2 m before the return
    CellScores to_cell_clearance;   ///< up to 1.5 cells before it
    double seconds = 0;             ///< of insertion
    std::size_t scans_inserted = 0;
};

/** One held-out scan as all maps predict it. */
struct ScanView {
    std::size_t scan = 0;  ///< counted from 0
    std::vector<Ray> rays;
    std::vector<std::vector<RayOutcome>> outcomes;  ///< for each map
};

struct ContestResult {
    ContestRules rules;
    std::size_t scans = 0, held_out = 0, folds = 0;  ///< held_out: in all folds
    std::vector<MapResult> maps;                     ///< one for each entrant
    Answers answers;                                 ///< to the queries of to_fixed_clearance
    std::optional<ScanView> view;
};

/** Builds the maps of all entrants from the scans that are not held out and judges them by those
 * that are. Reads the recording once for each fold; holds the fold's maps, and of the scans only
 * those held out. For a given recording only `seconds` differs between runs or numbers of threads.
 * \exception std::runtime_error if no scan is held out, nothing in the scans is usable, or there
 * are more than kMaxScoredCells queries */
[[nodiscard]] ContestResult holdContest(const Recording& recording,
                                        const std::vector<Entrant>& entrants,
                                        const ContestRules& rules);

/** The map named kReferenceEntrant, if it took part. Points into the result. */
[[nodiscard]] const MapResult* referenceOf(const ContestResult& result);

/** How a figure differs from the reference's, scan by scan. NaN without scans. */
struct PairedDifference {
    double mean, lowest, highest;
};
[[nodiscard]] PairedDifference pairedDifference(const MapResult& map, const MapResult& reference,
                                                double RayShares::*figure);

}  // namespace akimap::app
