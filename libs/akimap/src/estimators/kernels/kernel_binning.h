// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <utility>
#include <vector>

#include "estimators/Samples.h"
#include "numeric/Ldlt.h"
#include "numeric/rows.h"

namespace akimap {

constexpr int kSide = Block::kSide;  ///< [cells]

/** A sample's kernel ready to be added to rows of cells: lengths in cells, places such that cell
 * i's centre is at i, relative to the scan's anchor. Its ellipsoid is described by successive
 * regression, z first (see Ldlt), so that what it leaves of a row of cells is a parabola:
 *   1 - r^2 = 1 - dz^2 iz - ey^2 iy - ex^2 ix,  ey = dy - y_z dz,  ex = dx - x_z dz - x_y ey. */
struct alignas(64) Kernel {  // one cache line
    double x, y, z;
    double y_z, x_z, x_y;
    float iz, iy, ix;
    float weight;  // |H|^(-1/2) [m^-3]
};

/** The cells of a kernel's bounding box, both ends included; none if first > last on an axis. */
struct KernelBox {
    int32_t first[3], last[3];
};

/** A kernel that may reach a block: it meets the block's layers z in [begin, end). */
struct BlockOverlap {
    uint32_t kernel;
    uint16_t begin, end;
};

/** The blocks that the kernels of a scan meet; kept between scans. */
struct BlockBins {
    std::vector<KernelBox> boxes;        // of each kernel
    KeyTable numbers;                    // block key -> local number
    std::vector<uint64_t> keys;          // of the blocks met, in order of first meeting
    std::vector<uint32_t> start;         // of each block in `overlaps`; one more at the end
    std::vector<BlockOverlap> overlaps;  // grouped by block, the kernels ascending
    std::vector<std::pair<uint32_t, BlockOverlap>>
        pairs;  // (local block, overlap), kernels ascending
    /** Bins the boxes by the blocks of 8^3 cells that they meet. */
    void bin();
};

struct BinnedKernels : BlockBins {
    std::vector<Kernel> kernels;
};

/** Makes the kernels of a scan and bins them by the blocks of 8^3 cells that they meet. Runs in the
 * caller's TBB arena. */
void binKernels(const Samples& samples, const std::vector<Symmetric3>& H, double resolution,
                BinnedKernels& binned);

/** Adds the kernels that meet block number b of binKernels() to the sums of its cells, in the
 * samples' order: those of occupied samples to alpha, the others to beta.
 * \return whether a kernel reached the centre of any of its cells */
bool addKernels(const BinnedKernels& binned, std::size_t b, std::size_t occupied, float* alpha,
                float* beta);

}  // namespace akimap
