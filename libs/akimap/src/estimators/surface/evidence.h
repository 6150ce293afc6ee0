// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <vector>

#include "estimators/surface/FreeBalls.h"
#include "estimators/surface/patches.h"
#include "grid/BlockUpdate.h"

namespace akimap {

/** A block that a scan says something of: its numbers among the patches' and the free space's
 * blocks, KeyTable::kNone where it is not among them. */
struct EvidenceBlock {
    uint64_t key;
    uint32_t patches, free;
};

/** Buffers of addEvidence(), kept between scans. */
struct EvidenceWorkspace {
    std::vector<EvidenceBlock> blocks;
    BlockUpdate update;
};

/** A scan's free space: \a radius R of the largest balls [cells]. */
struct ScanFreeSpace {
    const FreeBalls& balls;
    double radius;
};

/** Adds one scan to the map: to each cell at most one observation of a surface and one of rays that
 * passed (doc/design.md). One task a block, so the sums are the same for any
 * number of threads; runs in the caller's TBB arena.
 * \param anchor of the hits
 * \param patches of the hits, by binPatches()
 * \param max_evidence alpha and beta are scaled down where they are more in sum; 0: never
 * \return whether any cell gained evidence
 * \exception std::bad_alloc with no sum changed */
bool addEvidence(const CellIndex& anchor, const BinnedPatches& patches, const ScanFreeSpace& free,
                 double max_evidence, BlockGrid& grid, EvidenceWorkspace& workspace);

}  // namespace akimap
