// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <octomap/OcTree.h>

#include <string>

#include "simulation/simulate.h"

namespace akimap::app {

/** Names of a drive's files. */
struct DriveFiles {
    explicit DriveFiles(const std::string& folder);
    std::string rawlog, trajectory, simplemap, truth, true_trajectory;
};

/** Makes the folder if it is missing.
 * \exception std::runtime_error naming what can't be written */
DriveFiles prepareFolder(const std::string& folder);

/** Writes the drive's files, all of them or none:
 * `scene.rawlog`, the observations one after another, as rawlog-grabber does;
 * `trajectory.tum`, the keyframes of the robot in the map, `time x y z qx qy qz qw`, as recorded;
 * `true_trajectory.tum`, the same without pose errors;
 * `scene.simplemap`, each scan, its points made, with the robot's pose at its timestamp;
 * `truth.bt`, OctoMap binary.
 * \param with_poses  adds the keyframes to the rawlog as CObservationRobotPose
 * \exception std::runtime_error naming the file that can't be written */
void writeDrive(const SimulatedDrive& drive, const octomap::OcTree& truth, const DriveFiles& files,
                bool with_poses);

}  // namespace akimap::app
