// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <akimap/rays.h>

#include "sensors/SensorFrame.h"
#include "sensors/beams.h"
#include "sensors/velodyne_rays.h"

namespace akimap {

/** Calls visit(Ray) for one in every `decimation` returns of an observation of a class that
 * givesRays(); the robot stands still. The observation is left as it was. No list of rays is made:
 * a particle filter asks for the likelihood thousands of times a scan. */
template <class Visitor>
void forEachReturn(const mrpt::obs::CObservation& obs, const mrpt::poses::CPose3D& robot,
                   std::size_t decimation, Visitor&& visit) {
    std::size_t number = 0;
    const auto isWanted = [&] { return number++ % decimation == 0; };
    const auto* velodyne = dynamic_cast<const mrpt::obs::CObservationVelodyneScan*>(&obs);
    if (velodyne && velodyne->point_cloud.x.empty()) {
        const auto at_rest = [&](mrpt::Clock::time_point) { return std::optional(robot); };
        const auto rays = raysOf(obs, at_rest);
        for (const Ray& ray : *rays)
            if (isWanted()) visit(ray);
        return;
    }
    const auto visitFrom = [&](const mrpt::poses::CPose3D& sensor_pose) {
        return [&, frame = SensorFrame(robot + sensor_pose)](double x, double y, double z, bool) {
            if (isWanted()) visit(frame.rayTo(x, y, z));
        };
    };
    if (velodyne)
        return forEachPoint(velodyne->point_cloud.x, velodyne->point_cloud.y,
                            velodyne->point_cloud.z, visitFrom(velodyne->sensorPose));
    visitDecodable(obs, [&](const auto& o) { forEachBeam(o, false, visitFrom(o.sensorPose)); });
}

}  // namespace akimap
