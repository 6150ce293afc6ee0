// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <akimap/Ray.h>
#include <mrpt/obs/CObservation.h>
#include <mrpt/poses/CPose3D.h>

#include <cstdint>
#include <vector>

#include "simulation/FieldOfView.h"
#include "simulation/Random.h"
#include "simulation/Scene.h"
#include "simulation/Trajectory.h"
#include "simulation/sensor_models.h"

namespace akimap::app {

/** What a sensor works in. */
struct World {
    const Scene& scene;
    const Trajectory& trajectory;
    bool moving;  ///< whether the robot drives during a scan
    RangeErrors errors;
    double max_range;  ///< [m] returns farther away are lost
    /** [m] What each beam of a lidar always measures too much; empty: nothing. */
    std::vector<double> beam_offsets = {};
};

/** The offsets of all beams; empty if there are none. */
std::vector<double> drawBeamOffsets(const SensorModel& sensor, const RangeErrors& errors,
                                    uint64_t seed);

struct SimulatedScan {
    mrpt::obs::CObservation::Ptr observation;  ///< with label, timestamp and sensorPose
    double time;                               ///< [s since 1970] the observation's timestamp
    mrpt::poses::CPose3D robot_pose;           ///< as recorded, in the map, at that time
    /** The returns in the map frame, as the observation decodes: errors of ranges and of the
     * recorded pose included, and each with the origin at its own time. */
    std::vector<Ray> rays;
    std::vector<View> views;  ///< from where (truly) and in which directions the scan looked
};

/** Takes the scan that starts at the time. The depth camera and the point-cloud sensor see all
 * at once; the VLP-16 takes 0.1 s, and each packet's rays start where the sensor was at the
 * time that MRPT reports for that packet. */
SimulatedScan takeScan(const SensorModel& sensor, const World& world, double time, Random& random);

// One for each pattern, in depth_camera.cpp, velodyne.cpp, point_sensor.cpp and ring_sensor.cpp.
SimulatedScan takeDepthScan(const SensorModel&, const World& world, double time, Random& random);
SimulatedScan takeVelodyneScan(const SensorModel&, const World& world, double time, Random& random);
SimulatedScan takePointScan(const SensorModel&, const World& world, double time, Random& random);
SimulatedScan takeRingScan(const SensorModel&, const World& world, double time, Random& random);

/** The measured range [m] with the world's errors, empty where no return is within the ranges.
 * Draws equally many random numbers for every ray, so that what one ray meets does not change the
 * errors of the next.
 * \param direction  of unit length, map frame
 * \param forward  depth for each metre of range: the cosine between ray and optical axis
 * \param beam  of a lidar, for its offset */
std::optional<double> measureRange(const World& world, const mrpt::math::TPoint3D& origin,
                                   const mrpt::math::TVector3D& direction, double min_range,
                                   Random& random, double forward = 1, std::size_t beam = 0);

/** From the sensor to a point in its frame. */
Ray rayTo(const mrpt::poses::CPose3D& sensor, const mrpt::math::TPoint3D& local_point);

}  // namespace akimap::app
