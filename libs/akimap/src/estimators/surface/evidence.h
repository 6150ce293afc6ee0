// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include "estimators/kernels/kernel_binning.h"
#include "estimators/surface/free_rays.h"

namespace akimap {

/** A block that a scan says something of: its numbers among the kernels' and the free space's
 * blocks, KeyTable::kNone where it is not among them. */
struct EvidenceBlock {
    uint64_t key;
    uint32_t kernels, power;
};

/** Buffers of the surface estimator, kept between scans. */
struct EvidenceScratch {
    SurfelScratch fit;
    std::vector<Surfel> surfels;
    FreeSpace free;
    std::vector<FreeSpace> free_parts;  // one a thread
    std::vector<EvidenceBlock> touched;
    std::vector<Block*> blocks;
    std::vector<std::shared_ptr<Block>> fresh;  // touched blocks that the grid does not have yet
    std::vector<char> reached;                  // whether a cell of it gained evidence
};

/** Adds one scan to the map: to each cell at most one observation of a surface and one of free
 * space, the surface before the free space. One task a block, so the sums are the same for any
 * number of threads; runs in the caller's TBB arena.
 * \param anchor of the hits
 * \param kernels of the hits, by groupKernels()
 * \param radius R of the free space [cells]
 * \param max_evidence alpha and beta are scaled down where they are more in sum; 0: never
 * \return whether any cell gained evidence
 * \exception std::bad_alloc with no sum changed */
bool addEvidence(const CellIndex& anchor, const ScatterScratch& kernels, const FreeSpace& free,
                 double radius, double max_evidence, BlockGrid& grid, EvidenceScratch& scratch);

}  // namespace akimap
