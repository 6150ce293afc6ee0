// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include "methods.h"
#include "report/Report.h"

namespace akimap::bench {

/** All methods against the truth of one scene: a table like the paper's Table II, ROC curves and
 * pictures of the maps. \param name for the files, without spaces */
[[nodiscard]] std::string accuracySection(Report& report, const Scene& scene,
                                          const std::string& name);

/** The rows of the paper's Table II (structured scene, all data), for comparison. */
[[nodiscard]] std::string paperTable();

}  // namespace akimap::bench
