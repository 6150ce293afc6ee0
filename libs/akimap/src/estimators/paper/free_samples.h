// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include "estimators/hits.h"

namespace akimap {

/** Rays -> samples. One occupied sample per hit cell, one free sample at a random place in every
 * sampling distance along each ray whose hit was taken, and one at its origin; at most one sample a
 * cell, a hit before a miss, the earlier before the later. Rays that met nothing come last.
 * \param taken scratch
 * \param scan_number with the seed it determines the random places
 * \param stats its drop and sample counters are increased */
void takeSamples(const std::vector<Ray>& rays, const InsertionParameters& parameters,
                 const BlockGrid& grid, uint64_t scan_number, KeyTable& taken, Samples& samples,
                 InsertionStats& stats);

}  // namespace akimap
