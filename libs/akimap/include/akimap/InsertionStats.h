// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <cstdint>

namespace akimap {

/** What insertions did since the map was made or cleared; not part of the map's state. */
struct InsertionStats {
    uint64_t scans = 0;              ///< insertions that changed the map
    uint64_t rays = 0;               ///< returns offered
    uint64_t points = 0;             ///< returns used: finite and within the ranges
    uint64_t dropped_nonfinite = 0;  ///< a coordinate of the end or the origin is NaN or infinite
    uint64_t dropped_zero = 0;       ///< zero-length rays
    uint64_t free_beams = 0;         ///< met nothing up to max_range and carved free space
    uint64_t dropped_range = 0;      ///< nearer than min_range, or beyond max_range and not free
    uint64_t dropped_grid = 0;       ///< outside the cells that can be addressed
    uint64_t dropped_poses = 0;      ///< scans or packets taken when the robot's pose was unknown
    uint64_t samples_occupied = 0, samples_free = 0;  ///< after thinning
    double seconds_sampling = 0, seconds_bandwidth = 0, seconds_update = 0;
};

}  // namespace akimap
