// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <akimap/Ray.h>
#include <octomap/OcTree.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "simulation/Scene.h"
#include "simulation/Trajectory.h"
#include "simulation/sensors.h"

namespace akimap::app {

struct SimulationOptions {
    SceneKind scene = SceneKind::structured;
    SensorKind sensor = SensorKind::depth;
    uint64_t seed = 1;          ///< places of things, small changes of pose, range noise
    bool moving = false;        ///< drive during each scan; only for SensorKind::velodyne
    double range_noise = 0.01;  ///< [m] >= 0. Standard deviation, Gaussian along the ray
    double max_range = 8.0;     ///< [m] > 0. Returns farther away are lost
};

/** A drive of 12 scans through one scene, from four places in three headings each. */
struct SimulatedDrive {
    Scene scene;
    Trajectory trajectory;
    std::vector<SimulatedScan> scans;

    /** What these scans can know of the scene, see visibleTruth(). Takes seconds.
     * \param resolution  side of a cell [m] */
    [[nodiscard]] std::unique_ptr<octomap::OcTree> truth(double resolution = 0.05) const;
};

/** The same options give the same bits.
 * \exception std::runtime_error naming the option that can't be */
SimulatedDrive simulate(const SimulationOptions& options);

/** Only the returns of simulate(), scan by scan: what insertRays() takes. */
std::vector<std::vector<Ray>> simulatedRays(const SimulationOptions& options);

}  // namespace akimap::app
