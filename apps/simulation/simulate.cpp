// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "simulation/simulate.h"

#include <stdexcept>
#include <string>
#include <utility>

#include "simulation/pose_errors.h"
#include "simulation/truth.h"

namespace akimap::app {

namespace {

void checkOptions(const SimulationOptions& options) {
    const SensorModel sensor = sensorModel(options.sensor);
    if (options.moving && sensor.pattern != Pattern::packets)
        throw std::runtime_error(
            "moving: only velodyne and vlp16 take their time over a scan; the others see all at "
            "once");
    check(options.errors.value_or(sensor.errors));
    check(options.pose_errors);
    // Above them the range image's 16 bits of millimetres and the packets' of 2 mm overflow.
    const double most = sensor.pattern == Pattern::image ? 60 : 120;
    const double max_range = options.max_range.value_or(sensor.max_range);
    if (!(max_range > 0 && max_range <= most))
        throw std::runtime_error("maximum range: " + std::to_string(max_range) +
                                 " m, but it must be above 0 and at most " + std::to_string(most));
}

}  // namespace

SimulatedDrive simulate(const SimulationOptions& options) {
    checkOptions(options);
    const SensorModel sensor = sensorModel(options.sensor);
    Scene scene = makeScene(options.scene, options.seed);
    Drive drive = makeDrive(scene, options.moving, options.seed);
    SimulatedDrive result{std::move(scene), drive.trajectory, {}, drive.trajectory};
    const RangeErrors errors = options.errors.value_or(sensor.errors);
    const World world{result.scene,
                      drive.trajectory,
                      options.moving,
                      errors,
                      options.max_range.value_or(sensor.max_range),
                      drawBeamOffsets(sensor, errors, options.seed)};
    Random random(options.seed, 3);
    for (const double time : drive.scan_times)
        result.scans.push_back(takeScan(sensor, world, time, random));
    if (options.pose_errors.any()) misplace(result, options.pose_errors, options.seed);
    return result;
}

std::unique_ptr<octomap::OcTree> SimulatedDrive::truth(double resolution) const {
    std::vector<View> views;
    for (const SimulatedScan& scan : scans)
        views.insert(views.end(), scan.views.begin(), scan.views.end());
    return visibleTruth(scene, views, resolution);
}

std::vector<std::vector<Ray>> simulatedRays(const SimulationOptions& options) {
    SimulatedDrive drive = simulate(options);
    std::vector<std::vector<Ray>> rays;
    rays.reserve(drive.scans.size());
    for (SimulatedScan& scan : drive.scans) rays.push_back(std::move(scan.rays));
    return rays;
}

}  // namespace akimap::app
