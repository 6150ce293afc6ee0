// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace akimap {

/** One beam of a sensor: it stood at `origin` and hit something at `end`; metres, map frame.
 * Each ray has its own origin, so that one scan of a moving sensor can have many. */
struct Ray {
    std::array<double, 3> origin;
    std::array<double, 3> end;
    bool hit = true;  ///< false: the beam came to `end`, the sensor's own range, and met nothing
};

[[nodiscard]] inline double lengthOf(const Ray& r) {  ///< [m]
    return std::hypot(r.end[0] - r.origin[0], r.end[1] - r.origin[1], r.end[2] - r.origin[2]);
}
/** The place [m] at a fraction of the way from the origin (0) to the end (1). */
[[nodiscard]] inline std::array<double, 3> placeAlong(const Ray& r, double fraction) {
    std::array<double, 3> p{};
    for (std::size_t i = 0; i < 3; i++) p[i] = r.origin[i] + fraction * (r.end[i] - r.origin[i]);
    return p;
}

}  // namespace akimap
