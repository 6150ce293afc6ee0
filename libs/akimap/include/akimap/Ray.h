// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <array>

namespace akimap {

/** One beam of a sensor: it stood at `origin` and hit something at `end`; metres, map frame.
 * Each ray has its own origin, so that one scan of a moving sensor can have many. */
struct Ray {
    std::array<double, 3> origin;
    std::array<double, 3> end;
    bool hit = true;  ///< false: the beam came to `end`, the sensor's own range, and met nothing
};

}  // namespace akimap
