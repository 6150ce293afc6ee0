// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <vector>

#include "estimators/kernels/kernel_binning.h"

namespace akimap {

/** The piece of surface around a hit: an ellipse on its plane. Lengths in cells; places such that
 * cell i's centre is at i, relative to the scan's anchor. */
struct Patch {
    double x, y, z;    ///< where the hit lies on the plane
    float normal[3];   ///< of the plane, of unit length, towards the sensor
    float u[3], v[3];  ///< the ellipse's axes: unit vectors divided by the semi-axes
    CellIndex cell;    ///< of the hit as it was measured
    float returns;     ///< how many of the scan ended in that cell
};

/** A scan's patches, binned by the blocks that they reach; kept between scans. */
struct BinnedPatches : BlockBins {
    std::vector<Patch> patches;
};

/** What a scan's patches say of the cells of a block, x running fastest. */
struct PatchSums {
    alignas(32) float weight[Block::kCells];   ///< sum of w
    alignas(32) float place[Block::kCells];    ///< sum of w d, d the signed distance [cells]
    alignas(32) float returns[Block::kCells];  ///< how many ended in the cell
};

/** Bins the patches. Runs in the caller's TBB arena. */
void binPatches(BinnedPatches& binned);

/** Replaces the sums by those of the patches that reach block number b. A patch is worth
 * w = (1 - 0.64 q)^4 at a cell's centre within the ellipse, where q < 1, as far as kPatchFront
 * before its plane and, falling to 0, kPatchBehind behind it. */
void sumPatches(const BinnedPatches& binned, std::size_t b, PatchSums& sums);

constexpr double kPatchFront = 2;   ///< [cells]
constexpr double kPatchBehind = 3;  ///< [cells]

}  // namespace akimap
