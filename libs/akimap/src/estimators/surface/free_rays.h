// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include "estimators/hits.h"
#include "estimators/surface/FreeBalls.h"
#include "estimators/surface/patches.h"

namespace akimap {

/** What the rays of a scan are marked with. */
struct RayMarking {
    double resolution;             ///< [m]
    double radius;                 ///< R, of the largest balls [cells]
    CellIndex anchor;              ///< of the samples: the marked blocks are relative to it
    const BinnedPatches& patches;  ///< of the hits
    const BlockGrid& grid;         ///< before the scan

    /** Where the block has surfaces, or gets some, its cells must know each ray that passes. */
    [[nodiscard]] Marking of(uint64_t block_key) const;
};

/** Marks the free space along each hit's ray: balls as wide as the gaps between rays, and narrower
 * where the hit's surface is near, whose plane they hardly cross. Each thread marks some of the
 * rays; the marks do not depend on which. Runs in the caller's TBB arena.
 * \param rays of the hits \param parts scratch \param free its marks are replaced */
void markHitRays(const RayMarking& marking, const std::vector<KeptRay>& rays,
                 std::vector<FreeBalls>& parts, FreeBalls& free);

/** Marks more, along beams that met nothing: balls within the sphere of the beam's length about its
 * origin. \param beams cut off where they are known to be free */
void markBeams(const RayMarking& marking, const std::vector<Ray>& beams, FreeBalls& free);

}  // namespace akimap
