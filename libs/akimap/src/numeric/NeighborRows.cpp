// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "numeric/NeighborRows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace akimap {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/** Puts two zeros between the lowest 21 bits of v. */
uint64_t spread(uint64_t v) {
    v = (v | v << 32) & 0x1f00000000ffff;
    v = (v | v << 16) & 0x1f0000ff0000ff;
    v = (v | v << 8) & 0x100f00f00f00f00f;
    v = (v | v << 4) & 0x10c30c30c30c30c3;
    return (v | v << 2) & 0x1249249249249249;
}

uint64_t axisKey(float v, float lowest, double per_grain) {
    return spread(static_cast<uint64_t>((static_cast<double>(v) - lowest) * per_grain));
}

/** One pass of a radix sort: stable, by 8 bits of the keys. */
void sortByDigit(const std::vector<uint64_t>& keys, const std::vector<uint32_t>& order, int shift,
                 std::vector<uint64_t>& sorted_keys, std::vector<uint32_t>& sorted_order) {
    std::array<uint32_t, 257> start{};
    for (const uint64_t k : keys) ++start[(k >> shift & 255) + 1];
    for (std::size_t d = 1; d < start.size(); d++) start[d] += start[d - 1];
    for (std::size_t i = 0; i < keys.size(); i++) {
        const uint32_t place = start[keys[i] >> shift & 255]++;
        sorted_keys[place] = keys[i];
        sorted_order[place] = order[i];
    }
}

}  // namespace

void NeighborRows::sort(const float* x, const float* y, const float* z, std::size_t n,
                        double grain) {
    const float lowest[3] = {*std::min_element(x, x + n), *std::min_element(y, y + n),
                             *std::min_element(z, z + n)};
    uint64_t used = 0;
    for (std::size_t i = 0; i < n; i++) {
        order_[i] = static_cast<uint32_t>(i);
        keys_[i] = axisKey(x[i], lowest[0], 1 / grain) | axisKey(y[i], lowest[1], 1 / grain) << 1 |
                   axisKey(z[i], lowest[2], 1 / grain) << 2;
        used |= keys_[i];
    }
    for (int shift = 0; shift < 64 && used >> shift; shift += 8) {
        sortByDigit(keys_, order_, shift, other_keys_, other_order_);
        keys_.swap(other_keys_);
        order_.swap(other_order_);
    }
}

void NeighborRows::build(const float* x, const float* y, const float* z, std::size_t n,
                         double grain) {
    for (auto* v : {&order_, &other_order_}) v->resize(n);
    for (auto* v : {&keys_, &other_keys_}) v->resize(n);
    levels_.clear();
    if (n == 0) return;
    sort(x, y, z, n, grain);
    const float* const from[3] = {x, y, z};
    for (std::size_t a = 0; a < 3; a++) {
        axis_[a].assign(rows() * kRow, kInfinity);
        for (std::size_t p = 0; p < n; p++) axis_[a][p] = from[a][order_[p]];
    }
    buildLevels();
}

void NeighborRows::buildLevels() {
    const auto inRows = [](std::size_t n) { return (n + kRow - 1) / kRow; };
    for (std::size_t n = size(); n > kRow || levels_.empty(); n = inRows(n)) {
        const bool lowest = levels_.empty();
        Level level;
        for (std::size_t a = 0; a < 3; a++) {
            const auto& low = lowest ? axis_[a] : levels_.back().low[a];
            const auto& high = lowest ? axis_[a] : levels_.back().high[a];
            level.low[a].assign(inRows(inRows(n)) * kRow, kInfinity);
            level.high[a].assign(inRows(inRows(n)) * kRow, -kInfinity);
            for (std::size_t i = 0; i < n; i++) {
                float &l = level.low[a][i / kRow], &h = level.high[a][i / kRow];
                l = std::min(l, low[i]), h = std::max(h, high[i]);
            }
        }
        levels_.push_back(std::move(level));
    }
}

Bounds NeighborRows::boundsOf(std::size_t row) const {
    Bounds b;
    for (std::size_t a = 0; a < 3; a++)
        b.low[a] = levels_[0].low[a][row], b.high[a] = levels_[0].high[a][row];
    return b;
}

AKIMAP_INLINE RowMask between(const float* low, const float* high, const Bounds& box, int axis) {
    return (loadRow(low) <= box.high[axis]) & (loadRow(high) >= box.low[axis]);
}

/** Appends those of a row of points that are in the box, without a branch for each: they would be
 * mispredicted. \pre room for the whole row */
AKIMAP_INLINE void appendInside(const float* x, const float* y, const float* z, RowMask valid,
                                const Bounds& box, PointList& found) {
    const Row px = loadRow(x), py = loadRow(y), pz = loadRow(z);
    const RowMask inside = valid & (px >= box.low[0]) & (px <= box.high[0]) & (py >= box.low[1]) &
                           (py <= box.high[1]) & (pz >= box.low[2]) & (pz <= box.high[2]);
    const uint32_t bits = bitsOf(inside);
    storeRow(&found.x[found.count], packed(px, bits));
    storeRow(&found.y[found.count], packed(py, bits));
    storeRow(&found.z[found.count], packed(pz, bits));
    found.count += static_cast<std::size_t>(__builtin_popcount(bits));
}

/** Level by level, without a branch for each box. */
AKIMAP_MULTIVERSION
void NeighborRows::findPoints(const Bounds& box, PointList& found) const {
    found.count = 0;
    if (levels_.empty()) return;
    std::vector<uint32_t>&boxes = found.boxes, &inner = found.inner_boxes;
    boxes.resize(std::max(boxes.size(), kRow));
    boxes[0] = 0;
    std::size_t count = 1;
    for (std::size_t level = levels_.size(); level-- > 0;) {
        const Level& l = levels_[level];
        inner.resize(std::max(inner.size(), (count + 1) * kRow));
        std::size_t n = 0;
        for (std::size_t b = 0; b < count; b++) {
            const std::size_t i = boxes[b] * kRow;
            const uint32_t bits = bitsOf(between(&l.low[0][i], &l.high[0][i], box, 0) &
                                         between(&l.low[1][i], &l.high[1][i], box, 1) &
                                         between(&l.low[2][i], &l.high[2][i], box, 2));
            storeRow(&inner[n], lanesOf(bits) + static_cast<int32_t>(i));
            n += static_cast<std::size_t>(__builtin_popcount(bits));
        }
        boxes.swap(inner);
        count = n;
    }
    found.reserve((count + 1) * kRow);
    for (std::size_t b = 0; b < count; b++) {
        const std::size_t i = boxes[b] * kRow;
        appendInside(&axis_[0][i], &axis_[1][i], &axis_[2][i], ~RowMask{}, box, found);
    }
}

AKIMAP_MULTIVERSION
void PointList::findPoints(const Bounds& box, PointList& found) const {
    found.count = 0;
    found.reserve(count + 2 * NeighborRows::kRow);
    for (std::size_t i = 0; i < count; i += NeighborRows::kRow)
        appendInside(&x[i], &y[i], &z[i], kLaneIndex < static_cast<int32_t>(count - i), box, found);
}

}  // namespace akimap
