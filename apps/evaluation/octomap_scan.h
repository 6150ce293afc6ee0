// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <akimap/Ray.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/poses/CPose3D.h>

#include <vector>

namespace akimap::app {

/** A scan as MRPT's maps take it: the cloud in the robot's frame, the robot at the ray origin.
 * (COctoMap ignores an observation's sensorPose.) */
struct PointCloudScan {
    mrpt::obs::CObservationPointCloud observation;
    mrpt::poses::CPose3D robot;
};
/** \pre one origin for the whole scan */
[[nodiscard]] PointCloudScan asPointCloud(const std::vector<Ray>& rays);

}  // namespace akimap::app
