// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <functional>
#include <optional>

#include "input/ScanSource.h"
#include "input/clouds/Cloud.h"

namespace akimap::app {

/** Makes the cloud the scan's rays, all from the scan's robot_pose and sensor_pose. */
void placeBare(Scan& scan, const Cloud& cloud, CloudFrame frame);

/** Where the sensor was in the map at a time. */
using SensorAt = std::function<std::optional<mrpt::poses::CPose3D>(mrpt::Clock::time_point)>;

/** The same for points of the sensor's frame, each from where the sensor was at its own time. Those
 * for which that is not known are left out, and counted. \param scan with its time */
void placeMoving(Scan& scan, const Cloud& cloud, const SensorAt& sensor_at, SkippedScans& skipped);

}  // namespace akimap::app
