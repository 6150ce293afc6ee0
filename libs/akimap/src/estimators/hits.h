// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <akimap/InsertionStats.h>
#include <akimap/Parameters.h>
#include <akimap/Ray.h>

#include <vector>

#include "estimators/Samples.h"

namespace akimap {

/** A ray whose hit became a sample, and its number among the usable ones. */
struct KeptRay {
    const Ray* ray;
    uint64_t number;
    uint32_t returns = 1;  ///< of the scan that ended in the same cell, this one included
};
struct KeptRays {
    std::vector<KeptRay> hits;
    std::vector<Ray> free;  ///< those that met nothing, cut off at max_range, at most one a cell
};

/** A scan's usable rays: the range rule, and at most one hit a cell, the earlier before the later.
 * \param samples replaced by the hits, in the order of KeptRays::hits
 * \param taken replaced by the cells of the hits
 * \param stats its counters of rays, drops and occupied samples are increased */
KeptRays takeHits(const std::vector<Ray>& rays, const ScanParameters& parameters,
                  const BlockGrid& grid, KeyTable& taken, Samples& samples, InsertionStats& stats);

}  // namespace akimap
