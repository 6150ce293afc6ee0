// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <array>
#include <vector>

#include "estimators/hits.h"
#include "numeric/Ldlt.h"
#include "numeric/NeighborRows.h"

namespace akimap {

/** The plane of the surface around a hit. */
struct HitPlane {
    std::array<float, 3> normal;  ///< of unit length, either way; only if `flat`
    bool flat;                    ///< whether the neighbours lie in a plane
};

/** Buffers of fitHitPlanes(), kept between scans. */
struct HitPlaneWorkspace {
    NeighborRows rows;
    std::vector<float> x, y, z;
};

/** Fits the local surface around each hit, by the covariance of its
 * neighbours about their mean. The neighbours lie in the smallest of a few balls that holds enough
 * of them. Moves hits on flat surfaces onto their plane, and gives each an ellipsoid H [m^2]: as
 * thin across the surface as the cells allow, and along it wide enough to reach the next hits.
 * \param rays of the hits
 * \param hits occupied samples only
 * The same for any number of threads; runs in the caller's TBB arena. */
void fitHitPlanes(const std::vector<KeptRay>& rays, Samples& hits,
                  const SurfaceParameters& parameters, double resolution,
                  HitPlaneWorkspace& workspace, std::vector<HitPlane>& planes,
                  std::vector<Symmetric3>& H);

/** The longest semi-axis [m] that fitHitPlanes() gives a hit on a surface. */
[[nodiscard]] double widestKernel(const SurfaceParameters& p, double resolution);

}  // namespace akimap
