// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "MapKind.h"

#include <akimap/AkiMap.h>
#include <mrpt/maps/COccupancyGridMap3D.h>
#include <mrpt/maps/COctoMap.h>
#if __has_include(<mrpt/maps/CVoxelMap.h>)
#include <mrpt/maps/CVoxelMap.h>
#endif

namespace akimap::bench {
namespace {

using mrpt::maps::CMetricMap;
using mrpt::math::TPoint3D;

constexpr double kCell = 0.1;  // [m]

/** \param range_of  the option for the longest range, of a map given */
template <class Map, class Make, class Occupancy, class RangeOf>
MapKind kind(const char* name, const char* ini, const char* range_key, Make make,
             Occupancy occupancy, RangeOf range_of) {
    MapKind k;
    k.name = name, k.ini = ini, k.max_range_key = range_key;
    k.make = make;
    k.occupancy = [=](const CMetricMap& m, const TPoint3D& p) {
        return occupancy(dynamic_cast<const Map&>(m), p);
    };
    k.max_range = [=](const CMetricMap& m) {
        Map& map = dynamic_cast<Map&>(const_cast<CMetricMap&>(m));
        return static_cast<double>(range_of(map));
    };
    k.set_max_range = [=](CMetricMap& m, double range) {
        auto& option = range_of(dynamic_cast<Map&>(m));
        option = static_cast<std::remove_reference_t<decltype(option)>>(range);
    };
    return k;
}

MapKind akiMap() {
    return kind<AkiMap>(
        "AkiMap", "akimap", "max_range", [] { return AkiMap::Create(kCell); },
        [](const AkiMap& m, const TPoint3D& p) { return m.occupancy(p.x, p.y, p.z).value_or(0.5); },
        [](AkiMap& m) -> double& { return m.insertionOptions.max_range; });
}

/** For classes with getPointOccupancy. */
template <class Map, class Range>
double pointOccupancy(const Map& m, const TPoint3D& p) {
    double value = 0.5;
    return m.getPointOccupancy(static_cast<Range>(p.x), static_cast<Range>(p.y),
                               static_cast<Range>(p.z), value)
               ? value
               : 0.5;
}

MapKind octoMap() {
    using mrpt::maps::COctoMap;
    return kind<COctoMap>(
        "COctoMap", "octoMap", "maxrange", [] { return COctoMap::Create(kCell); },
        pointOccupancy<COctoMap, float>,
        [](COctoMap& m) -> double& { return m.insertionOptions.maxrange; });
}

MapKind grid3D() {
    using mrpt::maps::COccupancyGridMap3D;
    return kind<COccupancyGridMap3D>(
        "COccupancyGridMap3D", "COccupancyGridMap3D", "maxDistanceInsertion",
        [] {
            return COccupancyGridMap3D::Create(TPoint3D(-2, -6, -2), TPoint3D(12, 8, 4),
                                               static_cast<float>(kCell));
        },
        [](const COccupancyGridMap3D& m, const TPoint3D& p) {
            const auto q = p.cast<float>();
            return 1 - static_cast<double>(m.getFreenessByPos(q.x, q.y, q.z));
        },
        [](COccupancyGridMap3D& m) -> float& { return m.insertionOptions.maxDistanceInsertion; });
}

#if __has_include(<mrpt/maps/CVoxelMap.h>)
MapKind voxelMap() {
    using mrpt::maps::CVoxelMap;
    return kind<CVoxelMap>(
        "CVoxelMap", "voxelMap", "max_range", [] { return CVoxelMap::Create(kCell); },
        pointOccupancy<CVoxelMap, double>,
        [](CVoxelMap& m) -> double& { return m.insertionOptions.max_range; });
}
#endif

}  // namespace

const std::vector<MapKind>& mapKinds() {
    static const std::vector<MapKind> kinds {
        akiMap(), octoMap(), grid3D(),
#if __has_include(<mrpt/maps/CVoxelMap.h>)
            voxelMap(),
#endif
    };
    return kinds;
}

}  // namespace akimap::bench
