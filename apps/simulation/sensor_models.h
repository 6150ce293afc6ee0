// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <cstdint>

#include "simulation/errors.h"

namespace akimap::app {

enum class SensorKind : uint8_t {
    depth,       ///< CObservation3DRangeScan with a range image of 1 mm units
    velodyne,    ///< CObservationVelodyneScan with raw VLP-16 packets
    pointcloud,  ///< CObservationPointCloud, random directions in a wide band
    kinect,      ///< as depth: Microsoft Kinect, every fourth pixel
    realsense,   ///< as depth: Intel RealSense D435, every fourth pixel
    vlp16,       ///< as velodyne: Velodyne VLP-16, all blocks
    os1_128,     ///< CObservationPointCloud: Ouster OS1-128, 1024 directions
    os0_64       ///< CObservationPointCloud: Ouster OS0-64, 2048 directions
};

/** How a sensor looks around. */
enum class Pattern : uint8_t {
    image,    ///< CObservation3DRangeScan
    packets,  ///< CObservationVelodyneScan
    random,   ///< CObservationPointCloud, random directions
    rings     ///< CObservationPointCloud, beams evenly apart
};

struct SensorModel {
    Pattern pattern;
    int columns, rows;            ///< pixels, or directions a turn and beams
    double half_width;            ///< of the image: tan of half its field of view
    double half_height;           ///< [rad] of the rings' band
    int filled_every;             ///< of the packets' blocks; those between have no returns
    double min_range, max_range;  ///< [m] returns nearer or farther are lost
    RangeErrors errors;
};

/** A sensor as its maker describes it; the first three kinds are ideal but for 1 cm of noise. */
[[nodiscard]] SensorModel sensorModel(SensorKind kind);

}  // namespace akimap::app
