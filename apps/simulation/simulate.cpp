// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "simulation/simulate.h"

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "simulation/truth.h"

namespace akimap::app {

namespace {

void check(const SimulationOptions& options) {
    if (options.moving && options.sensor != SensorKind::velodyne)
        throw std::runtime_error(
            "moving: only the velodyne sensor takes its time over a scan; depth and pointcloud "
            "see all at once");
    if (!(options.range_noise >= 0 && std::isfinite(options.range_noise)))
        throw std::runtime_error("range noise: " + std::to_string(options.range_noise) +
                                 " m, but it must be 0 or more");
    // Above it the range image's 16 bits of millimetres overflow.
    if (!(options.max_range > 0 && options.max_range <= 60))
        throw std::runtime_error("maximum range: " + std::to_string(options.max_range) +
                                 " m, but it must be above 0 and at most 60");
}

}  // namespace

SimulatedDrive simulate(const SimulationOptions& options) {
    check(options);
    Scene scene = makeScene(options.scene, options.seed);
    Drive drive = makeDrive(scene, options.moving, options.seed);
    SimulatedDrive result{std::move(scene), std::move(drive.trajectory), {}};
    const World world{result.scene, result.trajectory, options.moving, options.range_noise,
                      options.max_range};
    Random random(options.seed, 3);
    for (const double time : drive.scan_times)
        result.scans.push_back(takeScan(options.sensor, world, time, random));
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
