// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "simulation/sensors.h"

namespace akimap::app {

using mrpt::math::TPoint3D;

SimulatedScan takeScan(const SensorModel& sensor, const World& world, double time, Random& random) {
    switch (sensor.pattern) {
        case Pattern::image:
            return takeDepthScan(sensor, world, time, random);
        case Pattern::packets:
            return takeVelodyneScan(sensor, world, time, random);
        case Pattern::rings:
            return takeRingScan(sensor, world, time, random);
        default:
            return takePointScan(sensor, world, time, random);
    }
}

std::vector<double> drawBeamOffsets(const SensorModel& sensor, const RangeErrors& errors,
                                    uint64_t seed) {
    if (errors.beam_offset == 0) return {};
    Random random(seed, 7);
    std::vector<double> offsets;
    for (int i = 0; i < sensor.rows; i++) offsets.push_back(random.normal(errors.beam_offset));
    return offsets;
}

Ray rayTo(const mrpt::poses::CPose3D& sensor, const TPoint3D& local_point) {
    const TPoint3D end = sensor.composePoint(local_point);
    return {{sensor.x(), sensor.y(), sensor.z()}, {end.x, end.y, end.z}};
}

}  // namespace akimap::app
