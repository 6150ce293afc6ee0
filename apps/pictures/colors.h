// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

namespace akimap::app {

struct Color {
    float r = 0, g = 0, b = 0;  ///< in [0, 1]
};
[[nodiscard]] inline Color mix(const Color& a, const Color& b, float t) {
    return {a.r + t * (b.r - a.r), a.g + t * (b.g - a.g), a.b + t * (b.b - a.b)};
}
[[nodiscard]] inline Color operator*(const Color& c, float f) {
    return {c.r * f, c.g * f, c.b * f};
}

/** From indigo at 0 through blue, green and amber to red at 1; clamped outside. */
[[nodiscard]] Color heightColor(double t);

}  // namespace akimap::app
