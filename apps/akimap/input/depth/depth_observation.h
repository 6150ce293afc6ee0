// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>

#include <cstdint>
#include <functional>

#include "input/depth/intrinsics.h"

namespace akimap::app {

/** An observation of a depth image, without a time. Its sensorPose is in the camera's frame, of
 * which z is ahead, x right and y down, as ROS and all files of poses have it.
 * \param steps_at the depth at (x, y) in steps; 0 and 65535 where there is none
 * \exception std::runtime_error if the camera's centre is not in the image */
[[nodiscard]] mrpt::obs::CObservation3DRangeScan::Ptr depthObservation(
    unsigned width, unsigned height, const Intrinsics& camera, double metres_per_step,
    const std::function<uint16_t(unsigned x, unsigned y)>& steps_at);

}  // namespace akimap::app
