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

namespace akimap::app {

enum class SensorKind : uint8_t {
    depth,      ///< CObservation3DRangeScan with a range image of 1 mm units
    velodyne,   ///< CObservationVelodyneScan with raw VLP-16 packets
    pointcloud  ///< CObservationPointCloud, random directions in a wide band
};

/** What a sensor works in. */
struct World {
    const Scene& scene;
    const Trajectory& trajectory;
    bool moving;         ///< whether the robot drives during a scan
    double range_noise;  ///< [m] standard deviation
    double max_range;    ///< [m] returns farther away are lost
};

struct SimulatedScan {
    mrpt::obs::CObservation::Ptr observation;  ///< with label, timestamp and sensorPose
    double time;                               ///< [s since 1970] the observation's timestamp
    mrpt::poses::CPose3D robot_pose;           ///< in the map, at that time
    /** The returns in the map frame, as the observation decodes: noise and quantization
     * included, and each with the origin at its own time. */
    std::vector<Ray> rays;
    std::vector<View> views;  ///< from where and in which directions the scan looked
};

/** Takes the scan that starts at the time. The depth camera and the point-cloud sensor see all
 * at once; the VLP-16 takes 0.1 s, and each packet's rays start where the sensor was at the
 * time that MRPT reports for that packet. */
SimulatedScan takeScan(SensorKind kind, const World& world, double time, Random& random);

// One for each kind, in depth_camera.cpp, velodyne.cpp and point_sensor.cpp.
SimulatedScan takeDepthScan(const World& world, double time, Random& random);
SimulatedScan takeVelodyneScan(const World& world, double time, Random& random);
SimulatedScan takePointScan(const World& world, double time, Random& random);

/** The measured range [m] with noise, empty where nothing is within the ranges.
 * \param direction  of unit length, map frame */
std::optional<double> measureRange(const World& world, const mrpt::math::TPoint3D& origin,
                                   const mrpt::math::TVector3D& direction, double min_range,
                                   Random& random);

/** From the sensor to a point in its frame. */
Ray rayTo(const mrpt::poses::CPose3D& sensor, const mrpt::math::TPoint3D& local_point);

}  // namespace akimap::app
