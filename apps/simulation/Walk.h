// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <optional>
#include <vector>

#include "simulation/Scene.h"

namespace akimap::app {

/** Someone 1.75 m tall walks straight over the floor, at an even pace, and may stop halfway. */
struct Walk {
    double from_x, from_y, to_x, to_y;  ///< [m]
    double start;                       ///< [s] in the time of the scans
    double speed = 1.2;                 ///< [m/s]
    double stop = 0;                    ///< [s] they stand halfway

    [[nodiscard]] double end() const;  ///< [s]
    /** Legs, trunk and head at that time; none before the start and from the end on. */
    [[nodiscard]] std::vector<ShapePtr> at(double time) const;
};

/** The scene with the walker in it, as it is at that time. */
[[nodiscard]] Scene sceneAt(const Scene& scene, const Walk& walk, double time);

}  // namespace akimap::app
