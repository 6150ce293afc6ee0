// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <akimap/AkiMap.h>
#include <mrpt/maps/CMultiMetricMap.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/poses/CPose2D.h>
#include <mrpt/slam/CICP.h>
#include <mrpt/tfest/TMatchingPair.h>

#include <cmath>

#include "Row.h"

namespace akimap::bench {
namespace {

using mrpt::maps::CMetricMap;
using mrpt::maps::CSimplePointsMap;
using mrpt::maps::TMatchingExtraResults;
using mrpt::maps::TMatchingParams;
using mrpt::poses::CPose2D;
using mrpt::poses::CPose3D;

/** The sample's returns in the map. */
CSimplePointsMap points(const Sample& s = plainSample()) {
    CSimplePointsMap cloud;
    for (const auto& p : s.in_sensor) {
        const auto q = s.sensor().composePoint(p).cast<float>();
        cloud.insertPointFast(q.x, q.y, q.z);
    }
    cloud.mark_as_modified();
    return cloud;
}

std::string share(std::size_t count, std::size_t of) {
    const double part = static_cast<double>(count) / static_cast<double>(of);
    return part > 0.9 ? "works" : count == 0 ? "finds nothing" : "finds some";
}

template <class Determine>
std::string match(Determine&& determine) {
    TMatchingParams params;
    params.maxDistForCorrespondence = 0.1f, params.decimation_other_map_points = 1;
    mrpt::tfest::TMatchingPairList pairs;
    TMatchingExtraResults extra;
    const auto other = points();
    determine(other, pairs, params, extra);
    return share(pairs.size(), other.size());
}

std::string match2D(const MapKind& kind) {
    return match([&](const auto& other, auto& pairs, const auto& params, auto& extra) {
        filledMap(kind)->determineMatching2D(&other, CPose2D(), pairs, params, extra);
    });
}

std::string match3D(const MapKind& kind) {
    return match([&](const auto& other, auto& pairs, const auto& params, auto& extra) {
        filledMap(kind)->determineMatching3D(&other, CPose3D(), pairs, params, extra);
    });
}

std::string ratio(const CMetricMap& map, double best) {
    mrpt::maps::TMatchingRatioParams params;
    params.maxDistForCorr = 0.1f;
    const auto other = points();
    const double r = map.compute3DMatchingRatio(&other, CPose3D(), params);
    return r > 0.9 * best ? "works" : r == 0 ? "always 0" : "finds some";
}

std::string ratioAmongOthers(const MapKind& kind) {
    mrpt::maps::CMultiMetricMap maps;
    maps.maps.push_back(filledMap(kind));
    maps.maps.push_back(CSimplePointsMap::Create(points()));
    const std::string answer = ratio(maps, 1);
    return answer == "finds some" ? "works, counted as no match" : answer;
}

/** Of a point 0.5 m before the wall. */
std::string squareDistance(const MapKind& kind) {
    const Sample s = plainSample();
    const auto at = s.sensor().composePoint(s.in_sensor.at(s.in_sensor.size() / 2)).cast<float>();
    const float d = filledMap(kind)->squareDistanceToClosestCorrespondence(at.x - 0.5f, at.y);
    return std::abs(std::sqrt(d) - 0.5f) < 0.1f ? "works" : "wrong";
}

/** CICP from an offset of 10 cm. \param align  (CICP, map, points of the room) -> pose */
template <class Align>
std::string aligned(const MapKind& kind, const Sample& room, Align&& align) {
    mrpt::slam::CICP icp;
    icp.options.thresholdDist = 0.5f, icp.options.smallestThresholdDist = 0.05f;
    icp.options.skip_cov_calculation = true, icp.options.maxIterations = 100;
    const CPose3D found = align(icp, *mapOf(kind, room), points(room));
    return found.norm() < 0.05 ? "works" : "does not align";
}

std::string icp2D(const MapKind& kind, const Sample& room) {
    return aligned(kind, room, [](auto& icp, const auto& map, const auto& other) {
        return CPose3D(icp.Align(&map, &other, CPose2D(-0.1, 0, 0))->getMeanVal());
    });
}

std::string icp3D(const MapKind& kind, const Sample& room) {
    return aligned(kind, room, [](auto& icp, const auto& map, const auto& other) {
        const CPose3D guess(-0.1, 0, 0, 0, 0, 0);
        return icp.Align3D(&map, &other, guess)->getMeanVal();
    });
}

template <class Map>
std::string nearest(const Map& map) {
    const Sample s = plainSample();
    const auto at = s.sensor().composePoint(s.in_sensor.at(s.in_sensor.size() / 2)).cast<float>();
    mrpt::math::TPoint3Df found;
    float distance = 0;
    uint64_t index = 0;
    return map.nn_single_search(at, found, distance, index) && distance < 0.01f ? "works" : "wrong";
}

std::string nearestNeighbors(const MapKind& kind) {
    const auto map = filledMap(kind);
#if MRPT_VERSION >= 0x020b03
    const auto* searchable = dynamic_cast<const mrpt::maps::NearestNeighborsCapable*>(map.get());
    return searchable ? nearest(*searchable) : "not one";
#else
    const auto* akimap = dynamic_cast<const AkiMap*>(map.get());
    return akimap ? nearest(*akimap) + ", without the interface" : "not one";
#endif
}

}  // namespace

Section matchingRows(const Sample& room) {
    return {
        "Matching",
        "Against a points map of the same returns, on a wall, within 0.1 m; *works*: more than "
        "nine in ten are matched. `CICP` starts 0.1 m off, in a room, and ends within half a cell.",
        {{"`determineMatching2D`", match2D},
         {"`determineMatching3D`", match3D},
         {"`compute3DMatchingRatio`",
          [](const MapKind& kind) { return ratio(*filledMap(kind), 1); }},
         {"`compute3DMatchingRatio` of a `CMultiMetricMap` with it", ratioAmongOthers},
         {"`squareDistanceToClosestCorrespondence`", squareDistance},
         {"`CICP::Align` to it", [room](const MapKind& kind) { return icp2D(kind, room); }},
         {"`CICP::Align3D` to it", [room](const MapKind& kind) { return icp3D(kind, room); }},
         {"`NearestNeighborsCapable` (MRPT ≥ 2.11.3)", nearestNeighbors}}};
}

}  // namespace akimap::bench
