// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers

// Makes the maps that an INI file asks for and gives a scan to all of them.
// Usage: multi_metric_map MAPS.ini RAWLOG [SECTION], for instance with
//   akimap.ini and MRPT's test_velodyne_VLP16.rawlog
#include <akimap/AkiMap.h>
#include <mrpt/config/CConfigFile.h>
#include <mrpt/maps/CMultiMetricMap.h>
#include <mrpt/obs/CRawlog.h>

#include <iostream>

namespace {

void run(const std::string& ini, const std::string& rawlog, const std::string& section) {
    akimap::registerClasses();  // the linker may drop a library of which nothing is called

    mrpt::maps::TSetOfMetricMapInitializers maps;
    maps.loadFromConfigFile(mrpt::config::CConfigFile(ini), section);
    mrpt::maps::CMultiMetricMap all;
    all.setListOfMaps(maps);
    // Older versions of MRPT silently skip maps that they don't know.
    const auto map = all.mapByClass<akimap::AkiMap>();
    if (!map) throw std::runtime_error(ini + ": no akimap_count = 1 in [" + section + "]");

    mrpt::obs::CRawlog log;
    if (!log.loadFromRawLogFile(rawlog)) throw std::runtime_error("can't read " + rawlog);
    for (const auto& entry : log)
        if (const auto scan = std::dynamic_pointer_cast<mrpt::obs::CObservation>(entry))
            all.insertObservation(*scan);

    for (const auto& each : all.maps)
        std::cout << each->GetRuntimeClass()->className << ": " << each->asString() << "\n";
    std::cout << map->occupiedCells().size() << " occupied cells of " << map->resolution()
              << " m\n";
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 3 || argc > 4) {
        std::cerr << "usage: multi_metric_map MAPS.ini RAWLOG [SECTION=MappingApplication]\n";
        return 2;
    }
    try {
        run(argv[1], argv[2], argc > 3 ? argv[3] : "MappingApplication");
    } catch (const std::exception& e) {
        std::cerr << "multi_metric_map: " << e.what() << "\n";
        return 1;
    }
}
