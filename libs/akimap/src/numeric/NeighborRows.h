// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "numeric/rows.h"

namespace akimap {

/** Lowest and highest corner of an axis-aligned box [m]. */
struct Bounds {
    float low[3], high[3];
};

/** A list of points that keeps its memory. Its arrays are longer than its
 * count, so that rows can be read from any of its points. */
struct PointList {
    std::vector<float> x, y, z;
    std::size_t count = 0;
    std::vector<uint32_t> boxes, inner_boxes;  // scratch of findPoints()
    void reserve(std::size_t n) {
        if (n <= z.size()) return;  // the last: the others may be longer, if memory ran out
        for (auto* v : {&x, &y, &z}) v->resize(2 * n);
    }
    /** Replaces `found` by the points in the box, in order. */
    void findPoints(const Bounds& box, PointList& found) const;
};

/** Points [m] in rows of eight that lie near each other, with a tree of boxes
 * above the rows: the points are sorted along a Morton curve, a box encloses
 * each row, and one each eight boxes, up to a single one. A far outlier costs a
 * box, not memory or the others' time. Concurrent const calls are safe. */
class NeighborRows {
 public:
    static constexpr std::size_t kRow = 8;

    /** Replaces the contents. \param grain [m] points nearer than this keep no
     * particular order */
    void build(const float* x, const float* y, const float* z, std::size_t n, double grain);

    [[nodiscard]] std::size_t size() const { return order_.size(); }
    [[nodiscard]] std::size_t rows() const { return (size() + kRow - 1) / kRow; }
    /** Number of points in a row: eight but in the last. */
    [[nodiscard]] int countIn(std::size_t row) const {
        return static_cast<int>(row + 1 < rows() ? kRow : size() - row * kRow);
    }
    /** Coordinates in row order; the last row is filled up with points that are
     * far from all. */
    [[nodiscard]] const float* x() const { return axis_[0].data(); }
    [[nodiscard]] const float* y() const { return axis_[1].data(); }
    [[nodiscard]] const float* z() const { return axis_[2].data(); }
    /** Place in the input of the point at each place in row order. */
    [[nodiscard]] const std::vector<uint32_t>& order() const { return order_; }
    [[nodiscard]] Bounds boundsOf(std::size_t row) const;

    /** Replaces `found` by the points in the box, in row order. */
    void findPoints(const Bounds& box, PointList& found) const;

 private:
    /** Boxes by coordinate, in whole rows; the padding meets nothing. */
    struct Level {
        std::vector<float> low[3], high[3];
    };

    void sort(const float* x, const float* y, const float* z, std::size_t n, double grain);
    void buildLevels();

    std::vector<uint32_t> order_;
    std::vector<float> axis_[3];
    std::vector<Level> levels_;                // the rows' boxes first
    std::vector<uint64_t> keys_, other_keys_;  // scratch of sort()
    std::vector<uint32_t> other_order_;
};

}  // namespace akimap
