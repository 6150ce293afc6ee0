// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <sensor_msgs/Image.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/PointCloud2.h>

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservation3DRangeScan.h>

#include "input/clouds/Cloud.h"
#include "input/depth/intrinsics.h"

namespace akimap::app {

[[nodiscard]] mrpt::Clock::time_point timeOf(const ros::Time& stamp);

/** \exception std::runtime_error if it has no x, y and z, or fewer bytes than it says */
[[nodiscard]] Cloud cloudOf(const sensor_msgs::PointCloud2& message);

/** Its sensorPose is in the message's frame. */
[[nodiscard]] mrpt::obs::CObservation2DRangeScan::Ptr laserOf(
    const sensor_msgs::LaserScan& message);

/** Of 16UC1 [mm] or 32FC1 [m]. Its sensorPose is in the message's frame.
 * \exception std::runtime_error if it is of another encoding, or shorter than it says */
[[nodiscard]] mrpt::obs::CObservation3DRangeScan::Ptr depthOf(const sensor_msgs::Image& message,
                                                              const Intrinsics& camera);

}  // namespace akimap::app
