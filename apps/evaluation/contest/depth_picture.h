// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <string>

#include "evaluation/contest/contest.h"

namespace akimap::app {

/** What a picture may show. */
enum class DepthSource {
    scan_and_maps,
    maps_alone  ///< for recordings that may not be published: no map that got the scan either
};

/** Draws the scan of result.view: its measured depth, and for each map the depth at which it stops
 * the same rays and, below, where the two differ.
 * \exception std::runtime_error naming the file, or if no scan was kept or it has no rays */
void writeDepthPicture(const ContestResult& result, const std::string& file,
                       DepthSource source = DepthSource::scan_and_maps);

}  // namespace akimap::app
