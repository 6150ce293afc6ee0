// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "FreeSpace.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "simd.h"

namespace akimap {
namespace {

constexpr int kSide = Block::kSide;
using Cells = uint16_t __attribute__((vector_size(16)));  // a row of a block

AKIMAP_INLINE Cells loadCells(const uint16_t* p) {
    Cells v;
    std::memcpy(&v, p, sizeof v);
    return v;
}
AKIMAP_INLINE void storeCells(uint16_t* p, Cells v) {
    std::memcpy(p, &v, sizeof v);
}
AKIMAP_INLINE Cells lesser(Cells a, Cells b) {
    return a < b ? a : b;
}

/** out[i] = min over |d| <= reach of in[8 + i + d * stride] + cost[|d|], for a row of cells. */
AKIMAP_INLINE Cells leastAround(const uint16_t* in, int stride, int reach, const uint16_t* cost) {
    Cells least = loadCells(in);
    for (int d = 1; d <= reach; d++)
        least =
            lesser(least, lesser(loadCells(in - d * stride), loadCells(in + d * stride)) + cost[d]);
    return least;
}

/** A block and the two beside it on one axis; null where there is none. */
struct Neighborhood {
    const uint16_t *before, *here, *after;
};

/** Copies n cells from each of the three, far ones from where there is no block. */
AKIMAP_INLINE void gather(const Neighborhood& of, int offset, int n, uint16_t* out) {
    for (const uint16_t* plane : {of.before, of.here, of.after}) {
        if (plane)
            std::memcpy(out, plane + offset, static_cast<std::size_t>(n) * sizeof *out);
        else
            std::fill_n(out, n, FreeSpace::kFar);
        out += n;
    }
}

/** Along x a line of cells is one row of each block; along y, and z, whole rows, and layers, lie
 * one behind the other. */
AKIMAP_MULTIVERSION
void spreadBlock(int axis, const Neighborhood& of, int reach, const uint16_t* cost, uint16_t* out) {
    constexpr int kLayer = kSide * kSide;
    uint16_t line[3 * Block::kCells];
    const int stride = axis == 0 ? 1 : axis == 1 ? kSide : kLayer, run = stride * kSide;
    for (int begin = 0; begin < Block::kCells; begin += run) {
        gather(of, begin, run, line);
        for (int i = 0; i < run; i += kSide)
            storeCells(out + begin + i, leastAround(line + run + i, stride, reach, cost));
    }
}

uint64_t keyBeside(uint64_t key, int axis, int step) {
    CellIndex b = unpackKey(key);
    (axis == 0 ? b.x : axis == 1 ? b.y : b.z) += step;
    return packKey(b);
}

/** The least power distance of each of the 8 layers across an axis. */
AKIMAP_MULTIVERSION
void leastOfLayers(const FreeSpace::Plane& plane, int axis, uint16_t* least) {
    Cells along[kSide];  // of each layer across y or z; for x the layers are the cells of along[0]
    for (Cells& l : along) l = Cells{} + FreeSpace::kFar;
    for (int row = 0; row < kSide * kSide; row++) {
        Cells& l = along[axis == 0 ? 0 : axis == 1 ? row % kSide : row / kSide];
        l = lesser(l, loadCells(plane.data() + row * kSide));
    }
    if (axis == 0) return storeCells(least, along[0]);
    for (int i = 0; i < kSide; i++) {
        least[i] = along[i][0];
        for (int j = 1; j < kSide; j++) least[i] = std::min<uint16_t>(least[i], along[i][j]);
    }
}

}  // namespace

void FreeSpace::clear() {
    index_.clear(), keys_.clear(), planes_.clear();
}

uint32_t FreeSpace::numberOf(uint64_t key) {
    const auto [number, added] = index_.insert(key, static_cast<uint32_t>(keys_.size()));
    if (!added) return number;
    keys_.push_back(key);
    planes_.emplace_back().fill(kFar);
    return number;
}

/** Adds the blocks beside those whose balls reach over a face. */
void FreeSpace::growAlong(int axis, double radius) {
    const double limit = radius * radius * kUnit;
    const std::size_t n = keys_.size();
    std::vector<char> beyond(n, 0);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, n, 64), [&](const auto& r) {
        for (std::size_t b = r.begin(); b != r.end(); ++b) {
            uint16_t least[kSide];
            leastOfLayers(planes_[b], axis, least);
            for (int i = 0; i < kSide; i++) {
                const auto w = static_cast<double>(least[i]);
                if (w + kUnit * (i + 1) * (i + 1) < limit) beyond[b] |= 1;
                if (w + kUnit * (kSide - i) * (kSide - i) < limit) beyond[b] |= 2;
            }
        }
    });
    for (std::size_t b = 0; b < n; b++) {
        if (beyond[b] & 1) numberOf(keyBeside(keys_[b], axis, -1));
        if (beyond[b] & 2) numberOf(keyBeside(keys_[b], axis, +1));
    }
}

void FreeSpace::spreadAlong(int axis, int reach, const std::vector<uint16_t>& cost) {
    spread_.resize(planes_.size());
    const auto find = [&](uint64_t key) -> const uint16_t* {
        const uint32_t n = index_.find(key);
        return n == KeyTable::kNone ? nullptr : planes_[n].data();
    };
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, keys_.size(), 32), [&](const auto& r) {
        for (std::size_t b = r.begin(); b != r.end(); ++b)
            spreadBlock(axis,
                        {find(keyBeside(keys_[b], axis, -1)), planes_[b].data(),
                         find(keyBeside(keys_[b], axis, +1))},
                        reach, cost.data(), spread_[b].data());
    });
    planes_.swap(spread_);
}

void FreeSpace::spread(double radius) {
    const int reach = std::min(static_cast<int>(std::ceil(radius)), kMaxRadius);
    std::vector<uint16_t> cost;
    for (int d = 0; d <= reach; d++) cost.push_back(static_cast<uint16_t>(kUnit * d * d));
    for (int axis = 0; axis < 3; axis++) {
        growAlong(axis, radius);
        spreadAlong(axis, reach, cost);
    }
}

}  // namespace akimap
