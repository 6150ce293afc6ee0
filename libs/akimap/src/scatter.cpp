// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "scatter.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "kernel.h"

namespace akimap {
namespace {

constexpr int kSide = Block::kSide;

Kernel makeKernel(const Symmetric3& h, double x, double y, double z, double resolution) {
    Kernel k{};
    const double per_cell = 1 / resolution, scale = per_cell * per_cell;
    k.x = x * per_cell - 0.5, k.y = y * per_cell - 0.5, k.z = z * per_cell - 0.5;
    const Factored f(h);
    k.y_z = f.y_z, k.x_z = f.x_z, k.x_y = f.x_y;
    k.vz = f.vz * scale, k.vy = f.vy * scale, k.vx = f.vx * scale;
    k.iz = 1 / k.vz, k.iy = 1 / k.vy, k.ix = 1 / k.vx;
    k.reach_x = std::sqrt(h.xx * scale), k.reach_y = std::sqrt(h.yy * scale);
    k.weight = static_cast<float>(1 / std::sqrt(f.determinant()));
    return k;
}

/** Integers i with |i - center| < reach, clipped to [low, high]. */
struct Interval {
    int first, last;
    Interval(double center, double reach, int low, int high)
        : first(static_cast<int>(std::max<double>(std::ceil(center - reach), low))),
          last(static_cast<int>(std::min<double>(std::floor(center + reach), high))) {}
};

/** Adds one row of cells, the first of which is at x = 0, of a kernel that cuts the interval
 * center -+ half out of it. Near its ends 1 - u is a small difference and k the fifth power of it:
 * the ends are taken relative to a cell near the centre, where floats are densest. */
AKIMAP_INLINE void addRow(float* cells, double center, double half, float inverse_vx, float weight,
                          Row& reached) {
    constexpr Row lanes = {0, 1, 2, 3, 4, 5, 6, 7};
    const double near = std::floor(center);
    const float low = static_cast<float>(center - half - near),
                high = static_cast<float>(center + half - near);
    const Row t = lanes - static_cast<float>(near);
    const Row g_signed = (t - low) * (high - t) * inverse_vx;  // negative outside
    const Row g = keep(g_signed > 0.0f, g_signed);
    reached += g;
    storeRow(cells, loadRow(cells) + kernelOfSquare<Row>(1.0f - g, g) * weight);
}

/** Adds a kernel to the plane (alpha or beta) of the block whose lowest cell is (bx, by, bz). */
AKIMAP_INLINE void addKernel(const Kernel& k, int bx, int by, int bz, float* plane, Row& reached) {
    const double cz = k.z - bz, cy = k.y - by, cx = k.x - bx;
    const float inverse_vx = static_cast<float>(k.ix);
    const Interval zs(cz, std::sqrt(k.vz), 0, kSide - 1);
    for (int z = zs.first; z <= zs.last; z++) {
        const double dz = z - cz, left_z = 1 - dz * dz * k.iz;
        if (left_z <= 0) continue;
        const double y0 = cy + k.y_z * dz;
        const Interval ys(y0, std::sqrt(k.vy * left_z), 0, kSide - 1);
        for (int y = ys.first; y <= ys.last; y++) {
            const double ey = y - y0, left = left_z - ey * ey * k.iy;
            if (left <= 0) continue;
            const double x0 = cx + k.x_z * dz + k.x_y * ey, half = std::sqrt(k.vx * left);
            if (x0 + half <= 0 || x0 - half >= kSide - 1) continue;
            addRow(plane + Block::offset(0, y, z), x0, half, inverse_vx, k.weight, reached);
        }
    }
}

/** \return whether a kernel reached the centre of any of its cells */
AKIMAP_MULTIVERSION
bool addToBlock(const ScatterScratch& s, const uint32_t* first, const uint32_t* last,
                std::size_t occupied, const CellIndex& corner, Block& block) {
    Row reached{};  // the sum of 1 - u over all cells
    for (const uint32_t* i = first; i != last; ++i)
        addKernel(s.kernels[*i], corner.x, corner.y, corner.z,
                  *i < occupied ? block.alpha.data() : block.beta.data(), reached);
    return sumOf(reached) > 0;
}

void makeKernels(const Samples& samples, const std::vector<Symmetric3>& H, double resolution,
                 std::vector<Kernel>& kernels) {
    kernels.resize(samples.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, samples.size(), 512), [&](const auto& r) {
        for (std::size_t i = r.begin(); i != r.end(); ++i)
            kernels[i] = makeKernel(H[i], samples.x[i], samples.y[i], samples.z[i], resolution);
    });
}

int blockAt(double cell) {
    return static_cast<int>(std::floor(cell / kSide));
}

/** Lists the blocks (relative to the anchor) that each kernel's bounding box meets. */
void listTouched(ScatterScratch& s) {
    s.touched.clear(), s.keys.clear(), s.pairs.clear();
    for (uint32_t i = 0; i < s.kernels.size(); i++) {
        const Kernel& k = s.kernels[i];
        const double reach_z = std::sqrt(k.vz);
        const int x0 = blockAt(std::ceil(k.x - k.reach_x)), x1 = blockAt(k.x + k.reach_x);
        const int y0 = blockAt(std::ceil(k.y - k.reach_y)), y1 = blockAt(k.y + k.reach_y);
        const int z0 = blockAt(std::ceil(k.z - reach_z)), z1 = blockAt(k.z + reach_z);
        for (int z = z0; z <= z1; z++)
            for (int y = y0; y <= y1; y++)
                for (int x = x0; x <= x1; x++) {
                    const uint64_t key = packKey({x, y, z});
                    const auto [number, added] =
                        s.touched.insert(key, static_cast<uint32_t>(s.keys.size()));
                    if (added) s.keys.push_back(key);
                    s.pairs.emplace_back(number, i);
                }
    }
}

/** Counting sort of the pairs by block; within a block the kernels stay in order. */
void groupByBlock(ScatterScratch& s) {
    s.start.assign(s.keys.size() + 2, 0);
    for (const auto& [block, kernel] : s.pairs) ++s.start[block + 2];
    for (std::size_t b = 2; b < s.start.size(); b++) s.start[b] += s.start[b - 1];
    s.kernels_of.resize(s.pairs.size());
    for (const auto& [block, kernel] : s.pairs) s.kernels_of[s.start[block + 1]++] = kernel;
}

BlockGrid::BlockIndex blockInMap(uint64_t key, const CellIndex& anchor) {
    const CellIndex b = unpackKey(key), a = BlockGrid::blockOf(anchor);
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}

}  // namespace

bool scatter(const Samples& samples, const std::vector<Symmetric3>& H, BlockGrid& grid,
             ScatterScratch& s) {
    makeKernels(samples, H, grid.resolution(), s.kernels);
    listTouched(s);
    groupByBlock(s);

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
        const CellIndex c = unpackKey(s.keys[b]);
        const uint32_t* kernels = s.kernels_of.data();
        s.reached[b] =
            addToBlock(s, kernels + s.start[b], kernels + s.start[b + 1], samples.occupied,
                       {c.x * kSide, c.y * kSide, c.z * kSide}, *s.blocks[b]);
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
