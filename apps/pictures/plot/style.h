// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <cstddef>
#include <iterator>

#include "pictures/plot/Canvas.h"

namespace akimap::app {

inline constexpr Color kInk{.13f, .13f, .13f}, kGrid{.90f, .90f, .90f}, kPale{.60f, .60f, .60f};
inline const Canvas::TextStyle kSmall{11}, kNormal{12.5};
/** Okabe and Ito's colours, which colour-blind readers can tell apart. */
inline Color lineColor(std::size_t i) {
    constexpr Color kColors[] = {{0, .447f, .698f},     {.835f, .369f, 0},    {0, .620f, .451f},
                                 {.800f, .475f, .655f}, {.902f, .624f, 0},    {.337f, .706f, .914f},
                                 {.13f, .13f, .13f},    {.600f, .600f, .600f}};
    return kColors[i % std::size(kColors)];
}

inline Canvas::Stroke lineStroke(Color color, bool dashed) {
    return {color, 2, dashed ? std::vector<double>{6, 4} : std::vector<double>{}};
}

}  // namespace akimap::app
