// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "estimators/surface/patches.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace akimap {
namespace {

constexpr float kFall = 0.64f;
constexpr float kFront = static_cast<float>(kPatchFront),
                kBehind = static_cast<float>(kPatchBehind);

/** Of the cells that a patch may reach, and the hit's own, from which it may have moved away. */
KernelBox boxOf(const Patch& p) {
    KernelBox box;
    const int32_t cell[3] = {p.cell.x, p.cell.y, p.cell.z};
    const double place[3] = {p.x, p.y, p.z};
    const auto squared = [](const float(&a)[3]) {
        return static_cast<double>(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
    };
    const double uu = squared(p.u), vv = squared(p.v);
    for (int a = 0; a < 3; a++) {  // u / |u|^2 is the semi-axis as a vector
        const double u = static_cast<double>(p.u[a]) / uu, v = static_cast<double>(p.v[a]) / vv,
                     along = std::sqrt(u * u + v * v), n = static_cast<double>(p.normal[a]);
        const double up = std::max(n * kPatchFront, -n * kPatchBehind),
                     down = std::max(-n * kPatchFront, n * kPatchBehind);
        const double first = std::ceil(place[a] - along - down),
                     last = std::floor(place[a] + along + up);
        box.first[a] = std::min(static_cast<int32_t>(first), cell[a]);
        box.last[a] = std::max(static_cast<int32_t>(last), cell[a]);
    }
    return box;
}

/** A linear function over a block: its value at the lowest cell, and how it grows from cell to
 * cell. */
struct Linear {
    float at, dx, dy, dz;
    AKIMAP_INLINE Linear(const float (&slope)[3], const float (&from)[3])
        : at(slope[0] * from[0] + slope[1] * from[1] + slope[2] * from[2]),
          dx(slope[0]),
          dy(slope[1]),
          dz(slope[2]) {}
    [[nodiscard]] AKIMAP_INLINE float operator()(int y, int z) const {
        return at + dy * static_cast<float>(y) + dz * static_cast<float>(z);
    }
};

AKIMAP_INLINE void addPatch(const Patch& p, const KernelBox& box, const CellIndex& corner,
                            const BlockOverlap& layers, PatchSums& sums) {
    constexpr Row one = {1, 1, 1, 1, 1, 1, 1, 1}, lane = {0, 1, 2, 3, 4, 5, 6, 7};
    const float from[3] = {static_cast<float>(corner.x - p.x), static_cast<float>(corner.y - p.y),
                           static_cast<float>(corner.z - p.z)};
    const Linear distance(p.normal, from), u(p.u, from), v(p.v, from);
    const Row distance_x = lane * distance.dx, u_x = lane * u.dx, v_x = lane * v.dx;
    const float span = 7 * distance.dx, low = std::min(span, 0.0f), high = std::max(span, 0.0f);
    const int y_begin = std::max(box.first[1] - corner.y, 0),
              y_end = std::min(box.last[1] - corner.y, kSide - 1) + 1;
    for (int z = layers.begin; z < layers.end; z++)
        for (int y = y_begin; y < y_end; y++) {
            const float first = distance(y, z);
            if (first + low >= kFront || first + high <= -kBehind) continue;
            const Row d = distance_x + first, a = u_x + u(y, z), b = v_x + v(y, z);
            const Row q = a * a + b * b, g = one - kFall * q, fade = one + d * (1 / kBehind);
            const RowMask inside = (q < 1.0f) & (d < kFront) & (fade > 0.0f);
            const Row g2 = g * g, w = keep(inside, g2 * g2 * (fade < one ? fade : one));
            const int i = (z * kSide + y) * kSide;
            storeRow(sums.weight + i, loadRow(sums.weight + i) + w);
            storeRow(sums.place + i, loadRow(sums.place + i) + w * d);
        }
}

AKIMAP_MULTIVERSION
void addRange(const BinnedPatches& s, const BlockOverlap* first, const BlockOverlap* last,
              const CellIndex& corner, PatchSums& sums) {
    for (const BlockOverlap* t = first; t != last; ++t) {
        const Patch& p = s.patches[t->kernel];
        addPatch(p, s.boxes[t->kernel], corner, *t, sums);
        const CellIndex c{p.cell.x - corner.x, p.cell.y - corner.y, p.cell.z - corner.z};
        if (((c.x | c.y | c.z) & ~(kSide - 1)) == 0)
            sums.returns[Block::offset(c.x, c.y, c.z)] += p.returns;
    }
}

}  // namespace

void binPatches(BinnedPatches& s) {
    s.boxes.resize(s.patches.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, s.patches.size(), 512),
                      [&](const auto& r) {
                          for (std::size_t i = r.begin(); i != r.end(); ++i)
                              s.boxes[i] = boxOf(s.patches[i]);
                      });
    s.bin();
}

void sumPatches(const BinnedPatches& s, std::size_t b, PatchSums& sums) {
    std::memset(&sums, 0, sizeof sums);
    const CellIndex c = unpackKey(s.keys[b]);
    const BlockOverlap* overlaps = s.overlaps.data();
    addRange(s, overlaps + s.start[b], overlaps + s.start[b + 1],
             {c.x * kSide, c.y * kSide, c.z * kSide}, sums);
}

}  // namespace akimap
