// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "input/clouds/place_cloud.h"

#include <chrono>
#include <map>

namespace akimap::app {

using mrpt::poses::CPose3D;

namespace {

Ray rayFrom(const CPose3D& sensor, const std::array<double, 3>& p) {
    Ray ray{{sensor.x(), sensor.y(), sensor.z()}, {}};
    sensor.composePoint(p[0], p[1], p[2], ray.end[0], ray.end[1], ray.end[2]);
    return ray;
}

/** \param t [s] of a point: of the epoch, or since its scan's time */
mrpt::Clock::time_point timeOfPoint(double t, mrpt::Clock::time_point scan) {
    constexpr double kYear = 3e7;
    if (t > kYear) return mrpt::Clock::fromDouble(t);
    return scan +
           std::chrono::duration_cast<mrpt::Clock::duration>(std::chrono::duration<double>(t));
}

}  // namespace

void placeBare(Scan& scan, const Cloud& cloud, CloudFrame frame) {
    const CPose3D sensor = scan.robot_pose + scan.sensor_pose;
    scan.intensity = cloud.intensity;
    scan.rays.reserve(cloud.points.size());
    for (const auto& point : cloud.points)
        scan.rays.push_back(frame == CloudFrame::sensor
                                ? rayFrom(sensor, point)
                                : Ray{{sensor.x(), sensor.y(), sensor.z()}, point});
}

void placeMoving(Scan& scan, const Cloud& cloud, const SensorAt& sensor_at, SkippedScans& skipped) {
    std::map<double, std::optional<CPose3D>> sensors;  // many points have one time
    for (std::size_t i = 0; i < cloud.points.size(); i++) {
        const double t = cloud.time[i];
        auto at = sensors.find(t);
        if (at == sensors.end())
            at = sensors.emplace(t, sensor_at(timeOfPoint(t, scan.time.value()))).first;
        if (!at->second) {
            skipped.points_outside_trajectory++;
            continue;
        }
        scan.rays.push_back(rayFrom(*at->second, cloud.points[i]));
        if (!cloud.intensity.empty()) scan.intensity.push_back(cloud.intensity[i]);
    }
}

}  // namespace akimap::app
