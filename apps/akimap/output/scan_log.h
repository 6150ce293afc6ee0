// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <functional>
#include <string>

#include "input/ScanSource.h"

namespace akimap::app {

/** Gives scans one by one to the function that it gets. */
using GiveScans = std::function<void(const std::function<void(const Scan&)>&)>;

/** Writes scans with their poses as all of MRPT reads them: a .rawlog (a CObservationRobotPose
 * before each observation) or a .simplemap, by the target's extension. Bare rays become
 * CObservationPointCloud; scans without a time get one, a second apart.
 * \exception std::runtime_error naming the target if it can't be written; what `give` throws */
void writeScanLog(const std::string& target, const GiveScans& give);

/** A scan as one observation. \param fallback its time if it has none */
[[nodiscard]] mrpt::obs::CObservation::Ptr observationOf(const Scan& scan,
                                                         mrpt::Clock::time_point fallback);

}  // namespace akimap::app
