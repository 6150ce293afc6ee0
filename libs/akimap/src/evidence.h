// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include "FreeSpace.h"
#include "scatter.h"
#include "surfels.h"

namespace akimap {

/** Buffers of the surface estimator, kept between scans. */
struct EvidenceScratch {
    SurfelScratch fit;
    std::vector<Surfel> surfels;
    FreeSpace free;
    std::vector<BlockGrid::BlockIndex> where;  // the blocks to change
    std::vector<Block*> blocks;
    std::vector<std::shared_ptr<Block>> fresh;
};

/** Marks the free space along each hit's ray: balls as wide as the gaps between rays, and narrower
 * where the hit's surface is near, whose plane they hardly cross. \return number of balls */
std::size_t markFree(const std::vector<KeptRay>& rays, const std::vector<Surfel>& surfels,
                     double radius, double resolution, FreeSpace& free);

/** Adds one scan to the map: to each cell at most one observation of a surface and one of free
 * space, the surface before the free space.
 * \param surface the sums of the hits' kernels, as alpha
 * \param max_evidence alpha and beta are scaled down where they are more in sum; 0: never
 * \return whether any cell gained evidence
 * \exception std::bad_alloc with no sum changed */
bool addEvidence(const BlockGrid& surface, const FreeSpace& free, double radius,
                 double max_evidence, BlockGrid& grid, EvidenceScratch& scratch);

}  // namespace akimap
