// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <mrpt/obs/CObservation.h>

#include "input/ScanSource.h"

namespace akimap::app {

/** Whether the map takes observations of this one's class. */
[[nodiscard]] bool isScan(const mrpt::obs::CObservation& observation);

/** Whether the observation is a scan of the wanted sensor; counts it if it isn't. What is there
 * for the poses or for the reader, odometry or comments, is no skipped scan. */
[[nodiscard]] bool isWantedScan(const mrpt::obs::CObservation& observation,
                                const std::string& only_label, SkippedScans& skipped);

/** What to say when nothing tells where a log's scans were taken. */
[[nodiscard]] std::string fixedPoseWarning(const std::string& log_file);

}  // namespace akimap::app
