// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <akimap/Ray.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "grid/BlockGrid.h"

namespace akimap::app {

/** A half line: where it begins [m], its unit direction, and how far the return is [m]. */
struct Beam {
    explicit Beam(const Ray& ray) : origin(ray.origin) {
        for (std::size_t i = 0; i < 3; i++) direction[i] = ray.end[i] - ray.origin[i];
        length = std::hypot(direction[0], direction[1], direction[2]);
        for (double& d : direction) d /= length;
    }
    /** The place [m] at a distance [m] from the origin. */
    [[nodiscard]] std::array<double, 3> at(double distance) const {
        return {origin[0] + distance * direction[0], origin[1] + distance * direction[1],
                origin[2] + distance * direction[2]};
    }
    std::array<double, 3> origin, direction;
    double length;
};

/** Calls visit(CellIndex, enter, leave) for the cells on a beam, in their order, from the one with
 * its origin to the one that holds the place at `distance`; enter and leave [m] are distances from
 * the origin. Ends early when visit returns false. (Amanatides and Woo 1987.)
 * \pre the beam has a length */
template <class Visitor>
void walkCells(const Beam& beam, double distance, double resolution, Visitor&& visit) {
    std::array<int32_t, 3> cell, step;
    std::array<double, 3> next, stride;
    for (std::size_t i = 0; i < 3; i++) {
        const double d = beam.direction[i];
        cell[i] = static_cast<int32_t>(std::floor(beam.origin[i] / resolution));
        step[i] = d > 0 ? 1 : -1;
        stride[i] = d != 0 ? resolution / std::abs(d) : std::numeric_limits<double>::infinity();
        next[i] = d != 0 ? ((cell[i] + (d > 0 ? 1 : 0)) * resolution - beam.origin[i]) / d
                         : std::numeric_limits<double>::infinity();
    }
    for (double enter = 0; enter < distance;) {
        const std::size_t axis =
            next[0] <= next[1] && next[0] <= next[2] ? 0 : (next[1] <= next[2] ? 1 : 2);
        if (!visit(CellIndex{cell[0], cell[1], cell[2]}, enter, next[axis])) return;
        enter = next[axis];
        next[axis] += stride[axis];
        cell[axis] += step[axis];
    }
}

}  // namespace akimap::app
