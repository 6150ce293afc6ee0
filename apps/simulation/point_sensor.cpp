// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <mrpt/core/Clock.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CObservationPointCloud.h>

#include <cmath>

#include "simulation/sensors.h"

namespace akimap::app {

using mrpt::math::TVector3D;

namespace {

constexpr double kDegree = M_PI / 180;
constexpr double kHalfWidth = 60 * kDegree, kLow = -40 * kDegree, kHigh = 20 * kDegree;

/** Uniform over the band's solid angle. */
TVector3D randomDirection(Random& random) {
    const double azimuth = random.uniform(-kHalfWidth, kHalfWidth);
    const double z = random.uniform(std::sin(kLow), std::sin(kHigh));
    const double level = std::sqrt(1 - z * z);
    return {level * std::cos(azimuth), level * std::sin(azimuth), z};
}

}  // namespace

SimulatedScan takePointScan(const SensorModel& model, const World& world, double time,
                            Random& random) {
    auto obs = mrpt::obs::CObservationPointCloud::Create();
    obs->sensorLabel = "LIDAR";
    obs->timestamp = mrpt::Clock::fromDouble(time);
    obs->sensorPose = {0.2, -0.05, 0.65, -3 * kDegree, 2 * kDegree, 1 * kDegree};
    const auto cloud = mrpt::maps::CSimplePointsMap::Create();
    cloud->reserve(static_cast<std::size_t>(model.columns));
    obs->pointcloud = cloud;

    SimulatedScan scan{obs, time, world.trajectory.at(time), {}, {}};
    const mrpt::poses::CPose3D sensor = scan.robot_pose + obs->sensorPose;
    const mrpt::math::TPoint3D origin = sensor.translation();
    scan.rays.reserve(static_cast<std::size_t>(model.columns));
    for (int i = 0; i < model.columns; i++) {
        const TVector3D direction = randomDirection(random);
        const auto range =
            measureRange(world, origin, sensor.rotateVector(direction), model.min_range, random);
        if (!range) continue;
        const mrpt::math::TPoint3Df point = (direction * *range).cast<float>();
        cloud->insertPoint(point);
        scan.rays.push_back(rayTo(sensor, point.cast<double>()));
    }
    scan.views.push_back(
        {sensor, FieldOfView::band(0, kHalfWidth, kLow, kHigh), model.min_range, world.max_range});
    return scan;
}

}  // namespace akimap::app
