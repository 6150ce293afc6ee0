// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "scatter.h"

#include <tbb/parallel_for.h>

#include "kernel.h"

namespace akimap {
namespace {

constexpr int kSide = Block::kSide;

/** What a kernel leaves of the rows of a block: row r = (y, z) runs along x, and its cells have
 * 1 - r^2 = left[r] - (x - x0[r])^2 ix. */
struct Rows {
    alignas(32) double x0[kSide * kSide];
    alignas(32) float left[kSide * kSide];
};

/** Places 0 to 7 minus a place, in doubles until they are small: a thin kernel far from the
 * block's corner keeps its digits. */
constexpr DoubleRow kLow = {0, 1, 2, 3}, kHigh = {4, 5, 6, 7};

/** How far each place lies from the cells of its row; no more than that, rounding included. */
AKIMAP_INLINE Row outsideRow(Row x0) {
    constexpr float kMiddle = 3.5f, kMargin = 0.01f;
    const Row from_middle = x0 - kMiddle;
    const Row outside = (Row)((RowMask)from_middle & INT32_MAX) - (kMiddle + kMargin);
    return keep(outside > 0.0f, outside);
}

/** Cuts a kernel into the rows of the block's layers [begin, end), eight at a time.
 * \return one bit a row: whether the kernel may reach a cell of it */
AKIMAP_INLINE uint64_t cutIntoRows(const Kernel& k, const CellIndex& corner, int begin, int end,
                                   Rows& rows) {
    const double cz = k.z - corner.z, cy = k.y - corner.y, cx = k.x - corner.x;
    uint64_t reached = 0;
    for (int z = begin; z < end; z++) {
        const double dz = z - cz;
        const float left_z = 1 - static_cast<float>(dz * dz) * k.iz;
        const double y0 = cy + k.y_z * dz, x_layer = cx + k.x_z * dz;
        const DoubleRow ey_low = kLow - y0, ey_high = kHigh - y0;
        const Row ey = joined(ey_low, ey_high), left = left_z - ey * ey * k.iy;
        const DoubleRow x0_low = x_layer + k.x_y * ey_low, x0_high = x_layer + k.x_y * ey_high;
        storeRow(rows.left + z * kSide, left);
        storeRow(rows.x0 + z * kSide, x0_low);
        storeRow(rows.x0 + z * kSide + 4, x0_high);
        const Row ex = outsideRow(joined(x0_low, x0_high));
        reached |= static_cast<uint64_t>(bitsOf(left - ex * ex * k.ix > 0.0f)) << (z * kSide);
    }
    return reached;
}

/** Adds a kernel to the plane (alpha or beta) of the block with this lowest cell: first all of its
 * rows, then a single loop over those it reaches, as nested loops of two or three rounds each are
 * mispredicted most of the time. */
AKIMAP_INLINE void addKernel(const Kernel& k, const CellIndex& corner, const Touch& touch,
                             float* plane, Rows& rows, RowMask& reached) {
    uint64_t bits = cutIntoRows(k, corner, touch.begin, touch.end, rows);
    for (; bits; bits &= bits - 1) {
        const int r = __builtin_ctzll(bits);
        const Row ex = joined(kLow - rows.x0[r], kHigh - rows.x0[r]);
        const Row g_signed = rows.left[r] - ex * ex * k.ix;  // 1 - r^2: negative outside
        const Row g = keep(g_signed > 0.0f, g_signed);
        reached |= (RowMask)g;
        float* cells = plane + r * kSide;
        storeRow(cells, loadRow(cells) + kernelOfSquare<Row>(1.0f - g, g) * k.weight);
    }
}

/** \return whether a kernel reached the centre of any of its cells */
AKIMAP_MULTIVERSION
bool addToBlock(const ScatterScratch& s, const Touch* first, const Touch* last,
                std::size_t occupied, const CellIndex& corner, float* alpha, float* beta) {
    constexpr int kAhead = 4;
    Rows rows;
    RowMask reached{};  // not zero where 1 - r^2 > 0 was met
    for (const Touch* t = first; t != last; ++t) {
        if (t + kAhead < last) __builtin_prefetch(&s.kernels[t[kAhead].kernel]);
        addKernel(s.kernels[t->kernel], corner, *t, t->kernel < occupied ? alpha : beta, rows,
                  reached);
    }
    return bitsOf(reached != 0) != 0;
}

}  // namespace

BlockGrid::BlockIndex blockInMap(uint64_t key, const CellIndex& anchor) {
    const CellIndex b = unpackKey(key), a = BlockGrid::blockOf(anchor);
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}

bool addKernels(const ScatterScratch& s, std::size_t b, std::size_t occupied, float* alpha,
                float* beta) {
    const CellIndex c = unpackKey(s.keys[b]);
    const Touch* touches = s.touches.data();
    return addToBlock(s, touches + s.start[b], touches + s.start[b + 1], occupied,
                      {c.x * kSide, c.y * kSide, c.z * kSide}, alpha, beta);
}

bool scatter(const Samples& samples, const std::vector<Symmetric3>& H, BlockGrid& grid,
             ScatterScratch& s) {
    groupKernels(samples, H, grid.resolution(), s, KernelWeight::density);

    // All that may run out of memory comes before the first sum is changed.
    const std::size_t n = s.keys.size();
    s.blocks.assign(n, nullptr);
    s.fresh.assign(n, nullptr);
    s.reached.assign(n, 0);
    grid.reserve(grid.blockCount() + n);
    for (std::size_t b = 0; b < n; b++)
        s.blocks[b] = grid.own(blockInMap(s.keys[b], samples.anchor));
    tbb::parallel_for(std::size_t{0}, n, [&](std::size_t b) {
        if (s.blocks[b]) return;
        s.fresh[b] = std::make_shared<Block>();
        s.blocks[b] = s.fresh[b].get();
    });

    tbb::parallel_for(std::size_t{0}, n, [&](std::size_t b) {
        s.reached[b] =
            addKernels(s, b, samples.occupied, s.blocks[b]->alpha.data(), s.blocks[b]->beta.data());
    });

    bool changed = false;
    for (std::size_t b = 0; b < n; b++) {
        if (!s.reached[b]) continue;  // a bounding box can meet a block that the ellipsoid misses
        changed = true;
        if (s.fresh[b]) grid.adopt(blockInMap(s.keys[b], samples.anchor), std::move(s.fresh[b]));
    }
    s.fresh.clear();
    return changed;
}

}  // namespace akimap
