// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "simd.h"

namespace akimap {

/** Points [m] sorted into cubic bins, bins along x adjacent in memory: a box of bins is a few
 * contiguous runs of points, which suits rows of eight. Concurrent const calls are safe. */
class NeighborGrid {
 public:
    /** Replaces the contents. \param bin side of a bin [m]; made wider where the points are spread
     * so far that bins would outnumber them many times */
    void build(const float* x, const float* y, const float* z, std::size_t n, float bin);

    [[nodiscard]] std::size_t size() const { return order_.size(); }
    /** Coordinates in bin order, with a row of padding behind the last. */
    [[nodiscard]] const float* x() const { return x_.data(); }
    [[nodiscard]] const float* y() const { return y_.data(); }
    [[nodiscard]] const float* z() const { return z_.data(); }
    /** Place in the input of the point at each place in bin order. */
    [[nodiscard]] const std::vector<uint32_t>& order() const { return order_; }

    /** Calls visit(begin, end) for runs in bin order that together hold every point within the
     * box of half side `reach` around (px, py, pz), and others. */
    template <class Visitor>
    AKIMAP_INLINE void forEachRun(float px, float py, float pz, float reach,
                                  Visitor&& visit) const {
        if (order_.empty()) return;
        const Span xs = span(px, reach, 0), ys = span(py, reach, 1), zs = span(pz, reach, 2);
        if (xs.first > xs.last) return;
        for (int k = zs.first; k <= zs.last; k++)
            for (int j = ys.first; j <= ys.last; j++) {
                const uint32_t* row = &start_[static_cast<std::size_t>((k * count_[1] + j)) *
                                              static_cast<std::size_t>(count_[0])];
                const uint32_t begin = row[xs.first], end = row[xs.last + 1];
                if (begin < end) visit(begin, end);
            }
    }

 private:
    struct Span {
        int first, last;
    };
    [[nodiscard]] Span span(float p, float reach, int axis) const {
        // A little wider than reach: rounding must not lose a point on a bin's face.
        const float r = reach * 1.0001f, last = static_cast<float>(count_[axis] - 1);
        const float a = (p - r - lowest_[axis]) * per_bin_, b = (p + r - lowest_[axis]) * per_bin_;
        return {static_cast<int>(std::max(a, 0.0f)),
                b < 0 ? -1 : static_cast<int>(std::min(b, last))};
    }
    void chooseBins(const float* const xyz[3], std::size_t n, float bin);

    float lowest_[3] = {}, per_bin_ = 1;
    int count_[3] = {};
    std::vector<uint32_t> start_;  // of each bin, in order_; one more at the end
    std::vector<uint32_t> order_, bin_of_;
    std::vector<float> x_, y_, z_;
};

}  // namespace akimap
