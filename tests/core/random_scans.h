// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <akimap/Ray.h>

#include <random>
#include <vector>

namespace akimap::test {

/** A noisy corner of a room with a post in it, seen from a few places at a time. */
inline std::vector<Ray> randomScan(unsigned seed, std::size_t n, double max_range = 6) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    std::normal_distribution<double> noise(0, 0.01);
    std::vector<Ray> rays;
    while (rays.size() < n) {
        const double sensor = static_cast<double>(rays.size() % 4);
        const std::array<double, 3> origin{0.3 + 0.1 * sensor, -0.2, 0.9};
        std::array<double, 3> end{3 * unit(random), 3 * unit(random), 2 * unit(random)};
        switch (rays.size() % 3) {
            case 0:
                end[0] = 3 + noise(random);
                break;
            case 1:
                end[2] = noise(random);
                break;
            default:
                end = {1.5 + 0.1 * unit(random), 1.2 + noise(random), end[2]};
        }
        const double dx = end[0] - origin[0], dy = end[1] - origin[1], dz = end[2] - origin[2];
        if (dx * dx + dy * dy + dz * dz < max_range * max_range) rays.push_back({origin, end});
    }
    return rays;
}

}  // namespace akimap::test
