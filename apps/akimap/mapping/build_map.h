// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <string>
#include <vector>

#include "input/scan_feed.h"
#include "mapping/map_options.h"

namespace akimap::app {

/** The command line of `akimap build`. */
struct BuildRequest {
    InputRequest input;
    MapRequest map;
    bool realtime = false;  ///< lose the scans that a robot would lose while it maps
    double rate = 0;        ///< [Hz] of the scans, in place of their stamps; 0: their stamps

    std::string on_interrupt = "save";  ///< the map of the scans so far, or discard it
    std::string output;                 ///< the map
    std::vector<std::string> exports;
    std::string json;  ///< empty: none
    bool quiet = false;
};

/** Reads the inputs, builds the map and writes all outputs, the map first; prints the table unless
 * quiet. ^C ends the reading, and the map has the scans so far.
 * \exception Interrupted when such a map is written, or discarded as asked
 * \exception std::exception naming the file or parameter; no output but the JSON, which holds the
 *  error, is touched then, unless writing itself fails */
void buildMap(const BuildRequest& request);

}  // namespace akimap::app
