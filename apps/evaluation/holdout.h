// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <akimap/Options.h>
#include <akimap/Ray.h>

#include <cstddef>
#include <vector>

#include "evaluation/evaluate.h"

namespace akimap::app {

// Accuracy without a truth: a map is asked about the places that scans it never got went through.

/** A place [m] that a held-out ray shows to be occupied or free. */
struct Query {
    std::array<double, 3> place;
    bool occupied;
};

/** Along a ray, the places 0.5, 1, 1.5, ... m from its origin that are at least 0.2 m before its
 * end, free, and then its end, occupied. */
[[nodiscard]] std::vector<Query> queriesOf(const Ray& ray);

/** The same up to 1.5 cells before the end, and the place there too: 0.2 m before it is far enough
 * for a map to make its surfaces fat unnoticed. \param resolution [m] of the cells */
[[nodiscard]] std::vector<Query> closeQueriesOf(const Ray& ray, double resolution);

/** The rays that AkiMap::insertRays() would take by their length; finite ones only. */
[[nodiscard]] std::vector<Ray> raysInRange(const std::vector<Ray>& rays,
                                           const InsertionParameters& ranges);

/** What the map says at the places of all queries of the rays, in their order. `known`: where it
 * has evidence; `all`: p = 0.5 elsewhere. \exception std::runtime_error if there are no queries, or
 * more than kMaxScoredCells */
[[nodiscard]] ScoredCells collect(const OccupancyLookup& lookup, const std::vector<Ray>& held_out);

/** Whether the scan of this number, counted from 0, is one of scans every, 2 every, ... counted
 * from 1. */
[[nodiscard]] inline bool isHeldOut(std::size_t number, std::size_t every) {
    return (number + 1) % every == 0;
}

}  // namespace akimap::app
