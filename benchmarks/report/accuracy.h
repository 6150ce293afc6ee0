// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include "evaluation/report.h"
#include "methods.h"
#include "report/Report.h"
#include "report/figures.h"

namespace akimap::bench {

/** What one method came to. */
struct Outcome {
    Row row;
    app::Judgement judgement;  ///< of the first seed
    BuiltMap first;            ///< the map of the first seed
    double seconds;            ///< median of the seeds' insertion times
};

/** \param seeds runs, if the method is random; \param threads of AkiMap */
[[nodiscard]] Outcome judgeMethod(const Method& method, const Scene& scene,
                                  const std::vector<PreparedScan>& scans, int seeds,
                                  unsigned threads = 1);

/** All methods against the truth of one scene: a table like the paper's Table II, ROC curves and
 * pictures of the maps. \param name for the files, without spaces */
[[nodiscard]] std::string accuracySection(Report& report, const Scene& scene,
                                          const std::string& name);

/** The rows of the paper's Table II (structured scene, all data), for comparison. */
[[nodiscard]] std::string paperTable();

}  // namespace akimap::bench
