// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <akimap/rays.h>

#include "sensors/SensorFrame.h"
#include "sensors/beams.h"
#include "sensors/velodyne_rays.h"

namespace akimap {

using mrpt::obs::CObservation;
using mrpt::obs::CObservationVelodyneScan;

bool givesRays(const CObservation& obs) {
    return dynamic_cast<const CObservationVelodyneScan*>(&obs) || isDecodable(obs);
}

std::optional<std::vector<Ray>> raysOf(const CObservation& obs, const RobotPoseAt& robot_pose_at,
                                       bool moving, bool with_free) {
    std::vector<Ray> rays;
    if (const auto* velodyne = dynamic_cast<const CObservationVelodyneScan*>(&obs)) {
        addVelodyne(*velodyne, robot_pose_at, moving, with_free, rays);
        return rays;
    }
    const bool decodable = visitDecodable(obs, [&](const auto& o) {
        const auto robot = robot_pose_at(o.timestamp);
        if (!robot) return;
        const SensorFrame frame(*robot + o.sensorPose);
        forEachBeam(o, with_free, [&](double x, double y, double z, bool hit) {
            rays.push_back(frame.rayTo(x, y, z, hit));
        });
    });
    return decodable ? std::optional(std::move(rays)) : std::nullopt;
}

}  // namespace akimap
