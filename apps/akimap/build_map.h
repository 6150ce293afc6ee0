// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <akimap/AkiMap.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace akimap::app {

/** The command line of `akimap build`. */
struct BuildRequest {
    std::vector<std::string> inputs;
    std::string output;  ///< the map
    std::string config;  ///< an INI; empty: defaults
    std::string section = "MappingApplication";
    /** Settings of the command line, which win over the INI's. */
    std::vector<std::function<void(AkiMap::TMapDefinition&)>> settings;

    std::string trajectory;  ///< a TUM file for the rawlogs; empty: their own poses
    double max_gap = 0.5;    ///< [s] largest gap bridged between robot poses
    std::string only_label;  ///< empty: all sensors
    uint64_t first = 0;      ///< scans to take; 0: all
    bool partial = false;    ///< take what is whole of a cut rawlog
    bool follow = false;     ///< the last input is a rawlog that is still being written
    double idle = 10;        ///< [s] it is at its end when it has not grown for so long

    std::vector<std::string> exports;
    std::string json;  ///< empty: none
    bool quiet = false;
};

/** Reads the inputs, builds the map and writes all outputs; prints the table unless quiet.
 * \exception std::exception naming the file or parameter; no output is touched then, unless
 *  writing itself fails */
void buildMap(const BuildRequest& request);

}  // namespace akimap::app
