// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <algorithm>
#include <cmath>

#include "estimators/kernels/kernel_cuts.h"
#include "estimators/kernels/kernel_function.h"

namespace akimap {
namespace {

/** Adds a kernel to the sums (alpha or beta) of the block with this lowest cell: first all of its
 * rows, then a single loop over those it reaches, as nested loops of two or three rounds each are
 * mispredicted most of the time. */
template <Lanes lanes>
AKIMAP_INLINE void addKernel(const Kernel& k, const CellIndex& corner, const BlockOverlap& overlap,
                             float* sums, Rows& rows, RowMask& reached) {
    Layers layers;
    uint64_t bits = cutIntoLayers<lanes>(k, corner, overlap, layers);
    if (!bits) return;
    cutIntoRows(k, layers, overlap.begin, overlap.end, rows);
    for (; bits; bits &= bits - 1) {
        const int r = __builtin_ctzll(bits);
        Row ex, left;
        if constexpr (lanes == Lanes::x) {
            ex = joined(kLow - rows.x0[r], kHigh - rows.x0[r]);
            left = Row{} + rows.left[r];
        } else {
            const double x = kPlaces[r % kSide];
            const int layer = r - r % kSide;
            ex = joined(x - loadRow(rows.x0 + layer), x - loadRow(rows.x0 + layer + 4));
            left = loadRow(rows.left + layer);
        }
        const Row g_signed = left - ex * ex * k.ix;  // 1 - r^2: negative outside
        const Row g = keep(g_signed > 0.0f, g_signed);
        reached |= (RowMask)g;
        float* cells = sums + r * kSide;
        storeRow(cells, loadRow(cells) + kernelOfSquare<Row>(1.0f - g, g) * k.weight);
    }
}

/** The kernels that may reach a block. */
struct Overlaps {
    const BlockOverlap *first, *last;
    std::size_t occupied;  ///< kernels below this number are of occupied samples
};

/** \return whether a kernel reached the centre of any of its cells */
template <Lanes lanes>
AKIMAP_INLINE bool addAlong(const BinnedKernels& s, const Overlaps& overlaps,
                            const CellIndex& corner, float* alpha, float* beta) {
    constexpr int kAhead = 4;
    Rows rows;
    RowMask reached{};  // not zero where 1 - r^2 > 0 was met
    for (const BlockOverlap* t = overlaps.first; t != overlaps.last; ++t) {
        if (t + kAhead < overlaps.last) __builtin_prefetch(&s.kernels[t[kAhead].kernel]);
        addKernel<lanes>(s.kernels[t->kernel], corner, *t,
                         t->kernel < overlaps.occupied ? alpha : beta, rows, reached);
    }
    return bitsOf(reached != 0) != 0;
}

/** Whether most layers of the kernels are wider along y than along x. */
AKIMAP_INLINE Lanes widerAxis(const BinnedKernels& s, const Overlaps& overlaps) {
    int along_y = 0;  // layers, less those wider along x
    for (const BlockOverlap* t = overlaps.first; t != overlaps.last; ++t) {
        const Kernel& k = s.kernels[t->kernel];
        const auto x_y = static_cast<float>(k.x_y);
        const int layers = t->end - t->begin;
        along_y += k.iy + x_y * x_y * k.ix < k.ix ? layers : -layers;
    }
    return along_y > 0 ? Lanes::y : Lanes::x;
}

/** Swaps x and y of the sums of a block. */
AKIMAP_INLINE void transposeLayers(float* sums) {
    for (float* layer = sums; layer != sums + Block::kCells; layer += kSide * kSide) {
        Row rows[kSide], half[kSide];
        for (int i = 0; i < kSide; i++) rows[i] = loadRow(layer + i * kSide);
        for (int step = 0; step < 3; step++) {  // each interleaves the first half with the second
            for (int i = 0; i < kSide / 2; i++) {
                const Row a = rows[i], b = rows[i + kSide / 2];
                half[2 * i] = __builtin_shufflevector(a, b, 0, 8, 1, 9, 2, 10, 3, 11);
                half[2 * i + 1] = __builtin_shufflevector(a, b, 4, 12, 5, 13, 6, 14, 7, 15);
            }
            std::copy(half, half + kSide, rows);
        }
        for (int i = 0; i < kSide; i++) storeRow(layer + i * kSide, rows[i]);
    }
}

/** \return whether a kernel reached the centre of any of its cells */
AKIMAP_MULTIVERSION
bool addToBlock(const BinnedKernels& s, const Overlaps& overlaps, const CellIndex& corner,
                float* alpha, float* beta) {
    if (widerAxis(s, overlaps) == Lanes::x)
        return addAlong<Lanes::x>(s, overlaps, corner, alpha, beta);
    for (float* sums : {alpha, beta})
        if (sums) transposeLayers(sums);
    const bool reached = addAlong<Lanes::y>(s, overlaps, corner, alpha, beta);
    for (float* sums : {alpha, beta})
        if (sums) transposeLayers(sums);
    return reached;
}

}  // namespace

bool addKernels(const BinnedKernels& s, std::size_t b, std::size_t occupied, float* alpha,
                float* beta) {
    const CellIndex c = unpackKey(s.keys[b]);
    const BlockOverlap* overlaps = s.overlaps.data();
    return addToBlock(s, {overlaps + s.start[b], overlaps + s.start[b + 1], occupied},
                      {c.x * kSide, c.y * kSide, c.z * kSide}, alpha, beta);
}

}  // namespace akimap
