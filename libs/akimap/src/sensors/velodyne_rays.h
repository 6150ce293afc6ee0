// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <akimap/rays.h>
#include <mrpt/obs/CObservationVelodyneScan.h>

#include <vector>

namespace akimap {

/** Appends a Velodyne scan's rays: of its packets, each from the pose at its own time, or of its
 * cloud.
 * \param moving whether the packets are preferred to a cloud without times
 * \param with_free also beams without a return, which only packets tell of */
void addVelodyne(const mrpt::obs::CObservationVelodyneScan& o, const RobotPoseAt& robot_pose_at,
                 bool moving, bool with_free, std::vector<Ray>& rays);

}  // namespace akimap
