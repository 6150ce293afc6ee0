// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <memory>
#include <vector>

#include "bandwidth.h"

namespace akimap {

/** A sample's kernel ready to be added to rows of cells: lengths in cells, places such that cell
 * i's centre is at i, relative to the scan's anchor. Its ellipsoid is described by successive
 * regression, z first, so that the interval it cuts out of any row is known in closed form:
 *   (dz^2 / vz) + ((dy - y_z dz)^2 / vy) + ((dx - x_z dz - x_y (dy - y_z dz))^2 / vx) < 1. */
struct Kernel {
    double x, y, z;
    double vz, y_z, vy, x_z, x_y, vx;
    double iz, iy, ix;        // 1 / vz, 1 / vy, 1 / vx
    double reach_x, reach_y;  // half sides of the bounding box; that along z is sqrt(vz)
    float weight;             // |H|^(-1/2) [m^-3]
};

/** Buffers of the update stage, kept between scans. */
struct ScatterScratch {
    std::vector<Kernel> kernels;
    KeyTable touched;                         // block key -> local number
    std::vector<uint64_t> keys;               // of the touched blocks, in order of first touch
    std::vector<uint32_t> start, kernels_of;  // kernels that may reach each touched block
    std::vector<std::pair<uint32_t, uint32_t>> pairs;  // (local block, kernel), kernels ascending
    std::vector<Block*> blocks;
    std::vector<char> reached;  // whether a cell of it gained evidence
    std::vector<std::shared_ptr<Block>> fresh;  // touched blocks that the grid does not have yet
};

/** Room 4: adds every sample's weighted kernel to the alpha (occupied) or beta (free) of the cells
 * whose centres it reaches, Eq. (8)-(9). One task a block, kernels in the samples' order, so the
 * sums are the same for any number of threads; runs in the caller's TBB arena.
 * \return whether any cell gained evidence
 * \exception std::bad_alloc with no sum changed */
bool scatter(const Samples& samples, const std::vector<Symmetric3>& H, BlockGrid& grid,
             ScatterScratch& scratch);

}  // namespace akimap
