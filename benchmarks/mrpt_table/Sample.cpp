// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "Sample.h"

#include <mrpt/io/CMemoryStream.h>
#include <mrpt/serialization/CArchive.h>

#include <algorithm>

namespace akimap::bench {

using mrpt::maps::CMetricMap;
using mrpt::math::TPoint3D;
using mrpt::poses::CPose3D;

CPose3D Sample::sensor() const {
    CPose3D on_robot;
    observation->getSensorPose(on_robot);
    return robot + on_robot;
}

namespace {

template <class Count>
double share(const Sample& s, const CPose3D& sensor, double part, Count&& counts) {
    const auto n = std::count_if(s.in_sensor.begin(), s.in_sensor.end(), [&](const TPoint3D& p) {
        return counts(sensor.composePoint(p * part));
    });
    return static_cast<double>(n) / static_cast<double>(s.in_sensor.size());
}

}  // namespace

double shareOccupied(const MapKind& kind, const CMetricMap& map, const Sample& s,
                     const CPose3D& sensor) {
    return share(s, sensor, 1, [&](const TPoint3D& p) { return kind.occupancy(map, p) > 0.51; });
}

double shareFree(const MapKind& kind, const CMetricMap& map, const Sample& s) {
    return share(s, s.sensor(), 0.5,
                 [&](const TPoint3D& p) { return kind.occupancy(map, p) < 0.49; });
}

CMetricMap::Ptr filledMap(const MapKind& kind) {
    const auto map = kind.make();
    const Sample s = plainSample();
    map->insertObservation(*s.observation, s.robot);
    return map;
}

CMetricMap::Ptr mapOf(const MapKind& kind, const Sample& s) {
    if (!s.hasReturns()) return filledMap(kind);
    mrpt::obs::CObservation3DRangeScan scan;
    setPoints(scan, s.in_sensor);
    const auto map = kind.make();
    map->insertObservation(scan, s.sensor());
    return map;
}

std::string bytesOf(const mrpt::serialization::CSerializable& object) {
    mrpt::io::CMemoryStream stream;
    auto archive = mrpt::serialization::archiveFrom(stream);
    archive << object;
    return {static_cast<const char*>(stream.getRawBufferData()), stream.getTotalBytesCount()};
}

}  // namespace akimap::bench
