// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include "evaluation/report.h"
#include "methods.h"
#include "report/Report.h"
#include "report/figures.h"
#include "report/places.h"

namespace akimap::bench {

/** One recording of a scene, ready to be inserted. */
struct Recording {
    Scene scene;
    std::vector<PreparedScan> scans;
};
[[nodiscard]] std::vector<Recording> prepareAll(std::vector<Scene> recordings);

/** What one method came to. */
struct Outcome {
    Row row;
    app::Judgement judgement;  ///< of the first run
    BuiltMap first;            ///< the map of the first run
    double seconds;            ///< median of the runs' insertion times
};

/** The runs are runsOf() the method, each with a seed of its own. \param threads of AkiMap */
[[nodiscard]] Outcome judgeMethod(const Method& method, const std::vector<Recording>& recordings,
                                  int seeds, unsigned threads = 1);

/** All methods against the truth of one scene: a table like the paper's Table II, ROC curves and
 * pictures of the maps of the first recording. */
[[nodiscard]] std::string accuracySection(Report& report, const Place& place);

/** The rows of the paper's Table II (structured scene, all data), for comparison. */
[[nodiscard]] std::string paperTable();

}  // namespace akimap::bench
