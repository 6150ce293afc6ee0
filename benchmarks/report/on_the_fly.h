// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include "methods.h"
#include "report/Report.h"

namespace akimap::bench {

/** What a robot with this lidar would get into each map: scans offered, used and lost, and the
 * update times, as `akimap build --realtime` tells them; with a histogram of the update times. */
[[nodiscard]] std::string onTheFlySection(Report& report, const LidarDrive& drive,
                                          const std::string& name);

}  // namespace akimap::bench
