// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers

// consumer MAPS.ini SECTION: uses the library and the INI as an outsider would.
#include <akimap/AkiMap.h>
#include <mrpt/config/CConfigFile.h>
#include <mrpt/maps/CMultiMetricMap.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CObservationPointCloud.h>

#include <cstdio>

namespace {

/** A wall in the plane x = 1.02 m. */
mrpt::obs::CObservationPointCloud wall() {
    auto points = mrpt::maps::CSimplePointsMap::Create();
    for (int i = -20; i <= 20; i++)
        for (int j = -20; j <= 20; j++)
            points->insertPointFast(1.02f, 0.02f * float(i), 0.02f * float(j));
    mrpt::obs::CObservationPointCloud scan;
    scan.pointcloud = points;
    return scan;
}

void report(const char* name, const akimap::AkiMap& map) {
    const auto on_wall = map.occupancy(1.02, 0, 0), before = map.occupancy(0.5, 0, 0),
               behind = map.occupancy(2, 0, 0);
    std::printf("%s: wall %s, before %s, behind %s\n", name,
                on_wall && *on_wall > 0.5 ? "occupied" : "wrong",
                before && *before < 0.5 ? "free" : "wrong", behind ? "wrong" : "unknown");
}

}  // namespace

int main(int, char** argv) {
    akimap::registerClasses();

    akimap::AkiMap map(0.05);
    map.insertObservation(wall());
    report("own map", map);

    mrpt::maps::TSetOfMetricMapInitializers definitions;
    definitions.loadFromConfigFile(mrpt::config::CConfigFile(argv[1]), argv[2]);
    mrpt::maps::CMultiMetricMap maps;
    maps.setListOfMaps(definitions);
    maps.insertObservation(wall());
    const auto from_ini = maps.mapByClass<akimap::AkiMap>();
    if (!from_ini) return 1;
    report("map of the INI", *from_ini);

    const mrpt::maps::CMultiMetricMap copy = maps;  // by serializing: needs the registration
    report("its copy", *copy.mapByClass<akimap::AkiMap>());
}
