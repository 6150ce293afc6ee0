// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <memory>
#include <vector>

#include "estimators/paper/bandwidth.h"

namespace akimap {

/** A sample's kernel ready to be added to rows of cells: lengths in cells, places such that cell
 * i's centre is at i, relative to the scan's anchor. Its ellipsoid is described by successive
 * regression, z first (see Factored), so that what it leaves of a row of cells is a parabola:
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
struct Touch {
    uint32_t kernel;
    uint16_t begin, end;
};

/** Buffers of the update stage, kept between scans. */
struct ScatterScratch {
    std::vector<Kernel> kernels;
    std::vector<KernelBox> boxes;
    KeyTable touched;             // block key -> local number
    std::vector<uint64_t> keys;   // of the touched blocks, in order of first touch
    std::vector<uint32_t> start;  // of each touched block in `touches`; one more at the end
    std::vector<Touch> touches;   // grouped by block, the kernels ascending
    std::vector<std::pair<uint32_t, Touch>> pairs;  // (local block, touch), kernels ascending
    std::vector<Block*> blocks;
    std::vector<char> reached;                  // whether a cell of it gained evidence
    std::vector<std::shared_ptr<Block>> fresh;  // touched blocks that the grid does not have yet
};

/** What a kernel is worth at its centre. */
enum class KernelWeight : uint8_t {
    density,  ///< |H|^(-1/2) [m^-3]: the paper's
    one
};

/** The kernels of a scan, and which of them each block of 8^3 cells meets. Runs in the caller's TBB
 * arena. */
void groupKernels(const Samples& samples, const std::vector<Symmetric3>& H, double resolution,
                  ScatterScratch& scratch, KernelWeight weight);

/** Adds the kernels that meet block number b of groupKernels() to planes of its cells, in the
 * samples' order: those of occupied samples to alpha, the others to beta.
 * \return whether a kernel reached the centre of any of its cells */
bool addKernels(const ScatterScratch& scratch, std::size_t b, std::size_t occupied, float* alpha,
                float* beta);

/** A block of ScatterScratch::keys or FreeSpace::keys(), which are relative to the samples'. */
[[nodiscard]] BlockGrid::BlockIndex blockInMap(uint64_t key, const CellIndex& anchor);

/** Room 4: adds every sample's weighted kernel to the alpha (occupied) or beta (free) of the cells
 * whose centres it reaches, Eq. (8)-(9). One task a block, kernels in the samples' order, so the
 * sums are the same for any number of threads; runs in the caller's TBB arena.
 * \return whether any cell gained evidence
 * \exception std::bad_alloc with no sum changed */
bool scatter(const Samples& samples, const std::vector<Symmetric3>& H, BlockGrid& grid,
             ScatterScratch& scratch);

}  // namespace akimap
