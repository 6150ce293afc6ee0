// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <akimap/Ray.h>
#include <octomap/OcTree.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "simulation/Scene.h"
#include "simulation/Trajectory.h"
#include "simulation/sensors.h"

namespace akimap::app {

struct SimulationOptions {
    SceneKind scene = SceneKind::structured;
    SensorKind sensor = SensorKind::depth;
    uint64_t seed = 1;                  ///< places of things, small changes of pose, all errors
    bool moving = false;                ///< drive during each scan; only for lidars of packets
    std::optional<RangeErrors> errors;  ///< empty: the sensor's own, see sensorModel()
    std::optional<double> max_range;    ///< [m] > 0. Returns farther away are lost; empty: its own
    PoseErrors pose_errors;
};

/** A drive of 12 scans through one scene, from four places in three headings each. */
struct SimulatedDrive {
    Scene scene;
    Trajectory trajectory;  ///< as recorded
    std::vector<SimulatedScan> scans;
    Trajectory true_trajectory;  ///< the same without pose errors

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
