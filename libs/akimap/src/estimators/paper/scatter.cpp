// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "estimators/kernels/kernel_binning.h"

#include <tbb/parallel_for.h>

namespace akimap {

BlockGrid::BlockIndex blockInMap(uint64_t key, const CellIndex& anchor) {
    const CellIndex b = unpackKey(key), a = BlockGrid::blockOf(anchor);
    return {a.x + b.x, a.y + b.y, a.z + b.z};
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
