// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "simulation/sensors.h"

namespace akimap::app {

using mrpt::math::TPoint3D;

SimulatedScan takeScan(SensorKind kind, const World& world, double time, Random& random) {
    switch (kind) {
        case SensorKind::depth:
            return takeDepthScan(world, time, random);
        case SensorKind::velodyne:
            return takeVelodyneScan(world, time, random);
        default:
            return takePointScan(world, time, random);
    }
}

std::optional<double> measureRange(const World& world, const TPoint3D& origin,
                                   const mrpt::math::TVector3D& direction, double min_range,
                                   Random& random) {
    // Drawn for every ray, so that what one ray meets does not change the noise of the next.
    const double noise = random.normal(world.range_noise);
    const auto distance = world.scene.castRay(origin, direction);
    if (!distance) return std::nullopt;
    const double measured = *distance + noise;
    if (measured < min_range || measured > world.max_range) return std::nullopt;
    return measured;
}

Ray rayTo(const mrpt::poses::CPose3D& sensor, const TPoint3D& local_point) {
    const TPoint3D end = sensor.composePoint(local_point);
    return {{sensor.x(), sensor.y(), sensor.z()}, {end.x, end.y, end.z}};
}

}  // namespace akimap::app
