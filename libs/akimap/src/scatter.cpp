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
    const double yz = h.yz / h.zz, xz = h.xz / static_cast<double>(h.zz);
    const double vy = h.yy - yz * h.yz, xy = (h.xy - xz * h.yz) / vy;
    const double vx = h.xx - xz * h.xz - xy * xy * vy;
    k.y_z = yz, k.x_z = xz, k.x_y = xy;
    k.vz = h.zz * scale, k.vy = vy * scale, k.vx = vx * scale;
    k.reach_x = std::sqrt(h.xx * scale), k.reach_y = std::sqrt(h.yy * scale);
    k.weight = static_cast<float>(1 / std::sqrt(h.zz * vy * vx));
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
AKIMAP_INLINE void addRow(float* cells, double center, double half, float inverse_vx,
                          float weight) {
    constexpr Row lanes = {0, 1, 2, 3, 4, 5, 6, 7};
    const double near = std::floor(center);
    const float low = static_cast<float>(center - half - near),
                high = static_cast<float>(center + half - near);
    const Row t = lanes - static_cast<float>(near);
    const Row g_signed = (t - low) * (high - t) * inverse_vx;  // negative outside
    const Row g = keep(g_signed > 0.0f, g_signed);
    storeRow(cells, loadRow(cells) + kernelOfSquare<Row>(1.0f - g, g) * weight);
}

/** Adds a kernel to the plane (alpha or beta) of the block whose lowest cell is (bx, by, bz). */
AKIMAP_INLINE void addKernel(const Kernel& k, int bx, int by, int bz, float* plane) {
    const double cz = k.z - bz, cy = k.y - by, cx = k.x - bx;
    const float inverse_vx = static_cast<float>(1 / k.vx);
    const Interval zs(cz, std::sqrt(k.vz), 0, kSide - 1);
    for (int z = zs.first; z <= zs.last; z++) {
        const double dz = z - cz, left_z = 1 - dz * dz / k.vz;
        if (left_z <= 0) continue;
        const double y0 = cy + k.y_z * dz;
        const Interval ys(y0, std::sqrt(k.vy * left_z), 0, kSide - 1);
        for (int y = ys.first; y <= ys.last; y++) {
            const double ey = y - y0, left = left_z - ey * ey / k.vy;
            if (left <= 0) continue;
            const double x0 = cx + k.x_z * dz + k.x_y * ey, half = std::sqrt(k.vx * left);
            if (x0 + half <= 0 || x0 - half >= kSide - 1) continue;
            addRow(plane + Block::offset(0, y, z), x0, half, inverse_vx, k.weight);
        }
    }
}

AKIMAP_MULTIVERSION
void addToBlock(const ScatterScratch& s, const uint32_t* first, const uint32_t* last,
                std::size_t occupied, const CellIndex& corner, Block& block) {
    for (const uint32_t* i = first; i != last; ++i)
        addKernel(s.kernels[*i], corner.x, corner.y, corner.z,
                  *i < occupied ? block.alpha.data() : block.beta.data());
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

    s.blocks.resize(s.keys.size());
    s.fresh.clear();
    s.fresh.resize(s.keys.size());
    for (std::size_t b = 0; b < s.keys.size(); b++)
        s.blocks[b] = grid.find(blockInMap(s.keys[b], samples.anchor));

    tbb::parallel_for(std::size_t{0}, s.keys.size(), [&](std::size_t b) {
        if (!s.blocks[b]) s.fresh[b] = std::make_unique<Block>();
        const CellIndex c = unpackKey(s.keys[b]);
        addToBlock(s, &s.kernels_of[s.start[b]],
                   &s.kernels_of[s.start[b]] + (s.start[b + 1] - s.start[b]), samples.occupied,
                   {c.x * kSide, c.y * kSide, c.z * kSide},
                   s.blocks[b] ? *s.blocks[b] : *s.fresh[b]);
        // A bounding box can meet a block that the ellipsoid misses.
        if (s.fresh[b] && s.fresh[b]->isEmpty()) s.fresh[b].reset();
    });

    for (std::size_t b = 0; b < s.keys.size(); b++)
        if (s.fresh[b]) grid.adopt(blockInMap(s.keys[b], samples.anchor), std::move(s.fresh[b]));
    return !s.keys.empty();
}

}  // namespace akimap
