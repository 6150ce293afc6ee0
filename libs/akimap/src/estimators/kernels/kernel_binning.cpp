// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "estimators/kernels/kernel_binning.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace akimap {
namespace {

AKIMAP_INLINE Kernel makeKernel(const Symmetric3& h, const double (&place)[3], double resolution) {
    const double area = resolution * resolution;
    const Ldlt f(h);
    Kernel k{};
    k.x = place[0], k.y = place[1], k.z = place[2];
    k.y_z = f.y_z, k.x_z = f.x_z, k.x_y = f.x_y;
    k.iz = static_cast<float>(area / f.vz), k.iy = static_cast<float>(area / f.vy),
    k.ix = static_cast<float>(area / f.vx);
    k.weight = static_cast<float>(1 / std::sqrt(f.determinant()));
    return k;
}

AKIMAP_MULTIVERSION
void makeKernelRange(const Samples& s, const std::vector<Symmetric3>& H, double resolution,
                     std::size_t begin, std::size_t end, BinnedKernels& scratch) {
    const double per_cell = 1 / resolution;
    for (std::size_t i = begin; i < end; i++) {
        const double place[3] = {s.x[i] * per_cell - 0.5, s.y[i] * per_cell - 0.5,
                                 s.z[i] * per_cell - 0.5};
        const double variance[3] = {H[i].xx, H[i].yy, H[i].zz};
        scratch.kernels[i] = makeKernel(H[i], place, resolution);
        for (int a = 0; a < 3; a++) {
            const double reach = std::sqrt(variance[a]) * per_cell;
            scratch.boxes[i].first[a] = static_cast<int32_t>(std::ceil(place[a] - reach));
            scratch.boxes[i].last[a] = static_cast<int32_t>(std::floor(place[a] + reach));
        }
    }
}

void makeKernels(const Samples& samples, const std::vector<Symmetric3>& H, double resolution,
                 BinnedKernels& s) {
    s.kernels.resize(samples.size());
    s.boxes.resize(samples.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, samples.size(), 512), [&](const auto& r) {
        makeKernelRange(samples, H, resolution, r.begin(), r.end(), s);
    });
}

/** Lists the blocks (relative to the anchor) that each kernel's bounding box meets. */
void listOverlaps(BlockBins& s) {
    s.numbers.clear(), s.keys.clear(), s.pairs.clear();
    for (uint32_t i = 0; i < s.boxes.size(); i++) {
        const KernelBox& b = s.boxes[i];
        if (b.first[0] > b.last[0] || b.first[1] > b.last[1]) continue;  // between two cells
        for (int z = b.first[2] >> 3; z <= b.last[2] >> 3; z++) {
            const int begin = std::max(b.first[2] - z * kSide, 0),
                      end = std::min(b.last[2] - z * kSide, kSide - 1) + 1;
            const BlockOverlap overlap{i, static_cast<uint16_t>(begin), static_cast<uint16_t>(end)};
            for (int y = b.first[1] >> 3; y <= b.last[1] >> 3; y++)
                for (int x = b.first[0] >> 3; x <= b.last[0] >> 3; x++) {
                    const uint64_t key = packKey({x, y, z});
                    const auto [number, added] =
                        s.numbers.insert(key, static_cast<uint32_t>(s.keys.size()));
                    if (added) s.keys.push_back(key);
                    s.pairs.emplace_back(number, overlap);
                }
        }
    }
}

/** Counting sort of the pairs by block; within a block the kernels stay in order. */
void sortByBlock(BlockBins& s) {
    s.start.assign(s.keys.size() + 2, 0);
    for (const auto& [block, overlap] : s.pairs) ++s.start[block + 2];
    for (std::size_t b = 2; b < s.start.size(); b++) s.start[b] += s.start[b - 1];
    s.overlaps.resize(s.pairs.size());
    for (const auto& [block, overlap] : s.pairs) s.overlaps[s.start[block + 1]++] = overlap;
}

}  // namespace

void BlockBins::bin() {
    listOverlaps(*this);
    sortByBlock(*this);
}

void binKernels(const Samples& samples, const std::vector<Symmetric3>& H, double resolution,
                BinnedKernels& s) {
    makeKernels(samples, H, resolution, s);
    s.bin();
}

}  // namespace akimap
