// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <akimap/Ray.h>

#include <functional>
#include <string>
#include <vector>

#include "evaluation/contest/contest.h"
#include "report/Report.h"

namespace akimap::bench {

/** A recording, and how maps of it are judged: by scans that they never got. */
struct Trial {
    std::string name;              ///< recording, cells, range
    std::string file;              ///< for names of files, without spaces
    std::string what;              ///< place, sensor, and which constants were chosen on it, if any
    double resolution, max_range;  ///< [m]
    bool all_folds = true;         ///< ContestRules::all_folds
    bool has_picture = false;      ///< of one scan's depth by the maps
    std::function<std::vector<std::vector<Ray>>()> scans;  ///< none if it is not there
};

/** Those of $AKIMAP_DATA, in the report's order. */
[[nodiscard]] std::vector<Trial> realTrials();

/** \param doing gets what comes next
 * \param threads of AkiMap; 0: all cores \exception std::runtime_error as holdContest() */
[[nodiscard]] app::ContestResult hold(const Trial& trial,
                                      const std::vector<std::vector<Ray>>& scans,
                                      const std::function<void(const std::string&)>& doing,
                                      unsigned threads = 1);

/** Two tables: where the rays of the held-out scans end in each map, and what the maps say of the
 * cells that they went through. OctoMap+ is a yardstick: no best figure is its own. */
[[nodiscard]] std::string predictionTables(Report& report, const std::string& where,
                                           const app::ContestResult& result);

/** The trial whole; empty if its recording is not there. Adds to Report::real. */
[[nodiscard]] std::string predictionSection(Report& report, const Trial& trial);

/** What the columns mean. */
[[nodiscard]] std::string predictionLegend();

}  // namespace akimap::bench
