// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <akimap/AkiMap.h>

#include <optional>
#include <vector>

namespace akimap {

/** Room 1, what AkiMap::insertObservation() does first: an observation -> rays in the map frame, by
 * robotPose (+) sensorPose (+) point; each ray begins where the sensor was when it was taken.
 * Returns that the sensor itself marks invalid are left out; all others are there, finite or not.
 * The observation is left as it was (its externally stored data are loaded). Thread-safe. \param
 * moving whether packets of a Velodyne scan are wanted for their times even if it has a cloud
 * \param robot_pose_at asked once per observation, or once per packet of a Velodyne scan \return
 * empty if observations of this class can't be inserted; no rays if the pose is unknown */
[[nodiscard]] std::optional<std::vector<Ray>> raysOf(const mrpt::obs::CObservation& obs,
                                                     const AkiMap::RobotPoseAt& robot_pose_at,
                                                     bool moving = false);

/** Whether raysOf() knows observations of this class. */
[[nodiscard]] bool givesRays(const mrpt::obs::CObservation& obs);

}  // namespace akimap
