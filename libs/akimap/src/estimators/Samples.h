// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "grid/BlockGrid.h"

namespace akimap {

/** The occupancy samples of one scan (paper, Sec. IV-B), in a frame whose axes are the map's and
 * whose origin is a cell corner near the sensor, so that floats are exact enough anywhere. */
struct Samples {
    CellIndex anchor;             ///< the local frame's origin is this cell's lowest corner
    std::vector<float> x, y, z;   ///< [m] local frame
    std::vector<float> distance;  ///< [m] from the sample's own ray origin
    std::size_t occupied = 0;     ///< the first so many are occupied (y = 1), the rest free (y = 0)

    [[nodiscard]] std::size_t size() const { return x.size(); }
    void clear() {
        for (auto* v : {&x, &y, &z, &distance}) v->clear();
        occupied = 0;
    }
};

/** Appends samples, at most one a cell. */
class Sampler {
 public:
    /** \param samples its anchor is set \param taken keys of the cells that have one, relative to
     * the anchor; kept by the caller */
    Sampler(const BlockGrid& grid, KeyTable& taken, Samples& samples)
        : grid_(grid), taken_(taken), samples_(samples) {
        const CellIndex& a = samples.anchor;
        corner_ = {a.x * grid.resolution(), a.y * grid.resolution(), a.z * grid.resolution()};
    }
    /** \param p [m] map frame \return whether its cell was not taken */
    bool add(const std::array<double, 3>& p, double distance) {
        return addOrFind(p, distance) == kNew;
    }
    /** The same. \return kNew, or the sample that took the cell before */
    uint32_t addOrFind(const std::array<double, 3>& p, double distance) {
        const uint32_t by = take(p);
        if (by != kNew) return by;
        samples_.x.push_back(static_cast<float>(p[0] - corner_[0]));
        samples_.y.push_back(static_cast<float>(p[1] - corner_[1]));
        samples_.z.push_back(static_cast<float>(p[2] - corner_[2]));
        samples_.distance.push_back(static_cast<float>(distance));
        return kNew;
    }
    static constexpr uint32_t kNew = KeyTable::kNone;
    /** Takes the point's cell; who took it before, if any, or kNew. */
    uint32_t take(const std::array<double, 3>& p) {
        const auto [by, added] = taken_.insert(keyInScan(grid_.cellAt(p[0], p[1], p[2])),
                                               static_cast<uint32_t>(samples_.size()));
        return added ? kNew : by;
    }

 private:
    /** Unique within 2^20 cells of the anchor on each axis. */
    [[nodiscard]] uint64_t keyInScan(const CellIndex& c) const {
        const CellIndex& a = samples_.anchor;
        return packKey({c.x - a.x, c.y - a.y, c.z - a.z});
    }

    const BlockGrid& grid_;
    KeyTable& taken_;
    Samples& samples_;
    std::array<double, 3> corner_{};
};

}  // namespace akimap
