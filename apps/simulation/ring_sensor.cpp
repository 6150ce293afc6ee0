// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <mrpt/core/Clock.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CObservationPointCloud.h>

#include <cmath>

#include "simulation/sensors.h"

namespace akimap::app {

using mrpt::math::TVector3D;

SimulatedScan takeRingScan(const SensorModel& lidar, const World& world, double time,
                           Random& random) {
    constexpr double kDegree = M_PI / 180;
    auto obs = mrpt::obs::CObservationPointCloud::Create();
    obs->sensorLabel = "LIDAR";
    obs->timestamp = mrpt::Clock::fromDouble(time);
    obs->sensorPose = {0.2, 0.05, 0.9, 3 * kDegree, 2 * kDegree, -1 * kDegree};
    const auto cloud = mrpt::maps::CSimplePointsMap::Create();
    obs->pointcloud = cloud;

    SimulatedScan scan{obs, time, world.trajectory.at(time), {}, {}};
    const mrpt::poses::CPose3D sensor = scan.robot_pose + obs->sensorPose;
    const mrpt::math::TPoint3D origin = sensor.translation();
    for (int column = 0; column < lidar.columns; column++)
        for (int beam = 0; beam < lidar.rows; beam++) {
            const double up = lidar.half_height * (2.0 * beam / (lidar.rows - 1) - 1);
            const double azimuth = -2 * M_PI * column / lidar.columns;
            const TVector3D direction(std::cos(up) * std::cos(azimuth),
                                      std::cos(up) * std::sin(azimuth), std::sin(up));
            const auto range =
                measureRange(world, origin, sensor.rotateVector(direction), lidar.min_range, random,
                             1, static_cast<std::size_t>(beam));
            if (!range) continue;
            const mrpt::math::TPoint3Df point = (direction * *range).cast<float>();
            cloud->insertPoint(point);
            scan.rays.push_back(rayTo(sensor, point.cast<double>()));
        }
    scan.views.push_back({sensor, FieldOfView::band(0, M_PI, -lidar.half_height, lidar.half_height),
                          lidar.min_range, world.max_range});
    return scan;
}

}  // namespace akimap::app
