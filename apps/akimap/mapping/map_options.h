// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <akimap/AkiMap.h>

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

namespace akimap::app {

/** The map that a command line asks for. */
struct MapRequest {
    std::string config;  ///< an INI; empty: defaults
    std::string section = "MappingApplication";
    /** Settings of the command line, which win over the INI's. */
    std::vector<std::function<void(AkiMap::TMapDefinition&)>> settings;
};

/** Adds --config, --section and the map's own options, with their comments and defaults. */
void addMapOptions(CLI::App& command, MapRequest& request);

/** An empty map with all options set.
 * \exception std::exception naming the file or the parameter */
[[nodiscard]] AkiMap makeMapFor(const MapRequest& request);

}  // namespace akimap::app
