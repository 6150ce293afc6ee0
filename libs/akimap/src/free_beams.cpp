// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "free_beams.h"

#include <algorithm>
#include <cmath>

namespace akimap {
namespace {

constexpr double kStep = 0.5;                      // from ball to ball, over the radius
constexpr double kLeastBall = 0.25;                // [cells]
constexpr double kOffCenter = 0.8660254037844386;  // [cells] balls are centred on cells

/** Rounded up, so that the ball is not larger. */
uint16_t powerOf(double ball, double radius) {
    return static_cast<uint16_t>(std::ceil(FreeSpace::kUnit * (radius * radius - ball * ball)));
}

}  // namespace

std::size_t markFreeBeams(const std::vector<Ray>& beams, double radius, double resolution,
                          const CellIndex& anchor, FreeSpace& free) {
    std::size_t balls = 0;
    for (const Ray& r : beams) {
        std::array<double, 3> end{}, back{};  // [cells]
        for (std::size_t i = 0; i < 3; i++)
            end[i] = r.end[i] / resolution, back[i] = r.origin[i] / resolution - end[i];
        const double length = std::hypot(back[0], back[1], back[2]);
        for (double t = 1; t < length;) {  // from the end
            const double ball = std::min(radius, t - kOffCenter);
            const auto at = [&](std::size_t i) {
                return static_cast<int32_t>(std::floor(end[i] + back[i] * (t / length)));
            };
            if (ball >= kLeastBall) {
                free.mark({at(0) - anchor.x, at(1) - anchor.y, at(2) - anchor.z},
                          powerOf(ball, radius));
                balls++;
            }
            t += std::max(1.0, kStep * ball);
        }
    }
    return balls;
}

}  // namespace akimap
