// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <akimap/Ray.h>
#include <mrpt/core/Clock.h>
#include <mrpt/obs/CObservation.h>
#include <mrpt/poses/CPose3D.h>

#include <functional>
#include <optional>
#include <vector>

namespace akimap {

/** The robot's pose in the map at a time; empty where it is not known. */
using RobotPoseAt = std::function<std::optional<mrpt::poses::CPose3D>(mrpt::Clock::time_point)>;

// Beams without a return, for beyond_max_range = free. Each comes as a ray without a hit, as long
// as the observation's maxRange says:
//  - CObservation2DRangeScan: beams that are not valid;
//  - CObservation3DRangeScan: pixels of range 0, if it has its range image;
//  - CObservationVelodyneScan: distances of 0 and of maxRange and more, if it has its packets.
// A cloud has no directions for them: CObservationPointCloud, points3D and Velodyne clouds give
// none, and neither does CObservationRotatingScan, which does not keep its beams' elevations.
// No class tells "nothing there" from "not measured": where the sensor, its driver or a filter
// gives the same mark to what is too near, too dark or glass, these beams are no free space.

/** What AkiMap::insertObservation() does first: an observation -> rays in the map frame, by
 * robotPose (+) sensorPose (+) point; each ray begins where the sensor was when it was taken.
 * Returns that the sensor itself marks invalid are left out unless \a with_free, which makes rays
 * without a hit of them where it can (see above); all others are there, finite or not.
 * The observation is left as it was (its externally stored data are loaded). Thread-safe. \param
 * moving whether packets of a Velodyne scan are wanted for their times even if it has a cloud
 * \param robot_pose_at asked once per observation, or once per packet of a Velodyne scan \return
 * empty if observations of this class can't be inserted; no rays if the pose is unknown */
[[nodiscard]] std::optional<std::vector<Ray>> raysOf(const mrpt::obs::CObservation& obs,
                                                     const RobotPoseAt& robot_pose_at,
                                                     bool moving = false, bool with_free = false);

/** Whether raysOf() knows observations of this class. */
[[nodiscard]] bool givesRays(const mrpt::obs::CObservation& obs);

}  // namespace akimap
