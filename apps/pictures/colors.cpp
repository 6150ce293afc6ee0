// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "pictures/colors.h"

#include <algorithm>
#include <cmath>

namespace akimap::app {

Color heightColor(double t) {
    static constexpr Color kStops[] = {{.24f, .25f, .59f}, {.17f, .48f, .71f}, {.23f, .70f, .65f},
                                       {.59f, .82f, .43f}, {.98f, .78f, .31f}, {.94f, .47f, .24f},
                                       {.74f, .16f, .24f}};
    constexpr int kSteps = 6;
    const double place = std::clamp(t, 0.0, 1.0) * kSteps;
    const int i = std::min(static_cast<int>(place), kSteps - 1);
    return mix(kStops[i], kStops[i + 1], static_cast<float>(place - i));
}

}  // namespace akimap::app
