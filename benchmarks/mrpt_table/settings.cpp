// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <mrpt/config/CConfigFileMemory.h>
#include <mrpt/maps/CMultiMetricMap.h>

#include <iostream>
#include <sstream>

#include "Row.h"

namespace akimap::bench {
namespace {

/** The map that an INI with lines in one of its sections makes; null if it makes none. */
mrpt::maps::CMetricMap::Ptr made(const MapKind& kind, const std::string& section,
                                 const std::string& lines) {
    mrpt::config::CConfigFileMemory ini;
    ini.setContent("[map]\n" + kind.ini + "_count = 1\n[map_" + kind.ini + "_00_" + section +
                   "]\n" + lines + "\n");
    mrpt::maps::TSetOfMetricMapInitializers list;
    list.loadFromConfigFile(ini, "map");
    mrpt::maps::CMultiMetricMap maps;
    maps.setListOfMaps(list);
    return maps.maps.empty() ? nullptr : maps.maps.at(0);
}

std::string creation(const MapKind& kind) {
    const auto map = made(kind, "creationOpts", "resolution = 0.2");
    return map ? "works" : "no map";
}

std::string insertion(const MapKind& kind, const std::string& section) {
    const auto map = made(kind, section, kind.max_range_key + " = 3");
    if (!map) return "no map";
    return kind.max_range(*map) == 3 ? "read" : "ignored";
}

std::string unknownKey(const MapKind& kind) {
    std::ostringstream errors;
    std::streambuf* const before = std::cerr.rdbuf(errors.rdbuf());
    made(kind, "insertOpts", "no_such_key = 3");
    std::cerr.rdbuf(before);
    return errors.str().find("no_such_key") == std::string::npos ? "ignored" : "named in a warning";
}

std::string badValue(const MapKind& kind) {
    try {
        made(kind, "insertOpts", kind.max_range_key + " = far");
    } catch (const std::exception& e) {
        const bool named = std::string(e.what()).find(kind.max_range_key) != std::string::npos;
        return named ? "refused by name" : "refused";
    }
    return "ignored";
}

}  // namespace

Section settingsRows() {
    return {"INI",
            "A map made by `CMultiMetricMap::setListOfMaps` from an INI. Unknown keys "
            "are refused by `akimap build`, `slam` and `localize`.",
            {{"`<name>_count = 1`",
              [](const MapKind& kind) { return creation(kind) + ": `" + kind.ini + "_count`"; }},
             {"a section `..._insertOpts`",
              [](const MapKind& kind) { return insertion(kind, "insertOpts"); }},
             {"a section `..._insertionOpts`",
              [](const MapKind& kind) { return insertion(kind, "insertionOpts"); }},
             {"an unknown key", unknownKey},
             {"a value that is no number", badValue}}};
}

}  // namespace akimap::bench
