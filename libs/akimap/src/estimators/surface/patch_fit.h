// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <vector>

#include "estimators/hits.h"
#include "estimators/surface/patches.h"
#include "numeric/NeighborRows.h"

namespace akimap {

/** Fits the local surface around each hit, by the covariance of its neighbours about their mean.
 * The neighbours lie in the smallest of a few balls that holds enough of them. A patch is as wide
 * as its neighbours are scattered; where they do not lie in a plane it is small and faces the
 * sensor.
 * \param rays of the hits
 * \param hits occupied samples only
 * \param rows scratch
 * \param patches replaced by one for each hit
 * The same for any number of threads; runs in the caller's TBB arena. */
void fitPatches(const std::vector<KeptRay>& rays, const Samples& hits,
                const SurfaceParameters& parameters, double resolution, NeighborRows& rows,
                std::vector<Patch>& patches);

/** The longest semi-axis [m] that a patch may get. */
[[nodiscard]] double widestPatch(double resolution);

}  // namespace akimap
