// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <mrpt/maps/CMetricMap.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/poses/CPose3D.h>

#include <string>
#include <vector>

#include "MapKind.h"

namespace akimap::bench {

/** An observation and where its returns are. */
struct Sample {
    std::string name;  ///< its class and form, as the table has it
    mrpt::obs::CObservation::Ptr observation;
    mrpt::poses::CPose3D robot;                   ///< in the map
    std::vector<mrpt::math::TPoint3D> in_sensor;  ///< [m] its returns, sensor's frame
    /** Where the sensor is in the map. */
    [[nodiscard]] mrpt::poses::CPose3D sensor() const;
    /** Whether it holds returns that a 3D map can take. */
    [[nodiscard]] bool hasReturns() const { return !in_sensor.empty(); }
};

/** One of each class: a wall ahead, except for the Velodyne's packets, which see a room.
 * \param folder  for the image that one of them keeps in a file */
[[nodiscard]] std::vector<Sample> samples(const std::string& folder);
/** The wall as a CObservation3DRangeScan with image and points, taken from the robot's origin: what
 * every class puts in the right place. */
[[nodiscard]] Sample plainSample();
/** Gives it these points [m], sensor's frame. */
void setPoints(mrpt::obs::CObservation3DRangeScan& scan,
               const std::vector<mrpt::math::TPoint3D>& points);

/** Share of the sample's returns that lie in occupied cells, were the sensor at the pose. */
[[nodiscard]] double shareOccupied(const MapKind&, const mrpt::maps::CMetricMap&, const Sample&,
                                   const mrpt::poses::CPose3D& sensor);
/** Share of the places half way to its returns that lie in free cells. */
[[nodiscard]] double shareFree(const MapKind&, const mrpt::maps::CMetricMap&, const Sample&);

/** A map of the plain sample. */
[[nodiscard]] mrpt::maps::CMetricMap::Ptr filledMap(const MapKind&);
/** A map of the sample's returns, if it has some, put in as a plain sample's points. */
[[nodiscard]] mrpt::maps::CMetricMap::Ptr mapOf(const MapKind&, const Sample&);

/** What the object is written as. */
[[nodiscard]] std::string bytesOf(const mrpt::serialization::CSerializable&);

}  // namespace akimap::bench
