// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <algorithm>

#include "estimators/Samples.h"
#include "numeric/Ldlt.h"
#include "numeric/NeighborRows.h"

namespace akimap {

constexpr double kEnough = 10;     // neighbours, the hit included
constexpr double kSmallest = 2.5;  // [cells] radius of the first ball
constexpr double kGrowth = 1.3;    // from ball to ball
constexpr double kTaper = 0.5;     // neighbours at the ball's surface weigh 1 - kTaper

/** Weighted number and moments of the points in a ball, about its centre. */
struct BallMoments {
    double n = 0, w = 0, x = 0, y = 0, z = 0;
    Symmetric3 m2;
};

AKIMAP_INLINE BallMoments momentsIn(const PointList& points, float cx, float cy, float cz,
                                    float radius) {
    Row n{}, w{}, x{}, y{}, z{}, xx{}, xy{}, xz{}, yy{}, yz{}, zz{};
    constexpr Row one = {1, 1, 1, 1, 1, 1, 1, 1};
    const float limit = radius * radius, taper = static_cast<float>(kTaper) / limit;
    for (std::size_t i = 0; i < points.count; i += 8) {
        const Row dx = loadRow(&points.x[i]) - cx, dy = loadRow(&points.y[i]) - cy,
                  dz = loadRow(&points.z[i]) - cz, u = dx * dx + dy * dy + dz * dz;
        const RowMask inside = (kLaneIndex < static_cast<int32_t>(points.count - i)) & (u <= limit);
        const Row v = keep(inside, 1.0f - taper * u);
        const Row vx = v * dx, vy = v * dy, vz = v * dz;
        n += keep(inside, one), w += v, x += vx, y += vy, z += vz;
        xx += vx * dx, xy += vx * dy, xz += vx * dz, yy += vy * dy, yz += vy * dz, zz += vz * dz;
    }
    return {sumOf(n), sumOf(w), sumOf(x),
            sumOf(y), sumOf(z), {sumOf(xx), sumOf(xy), sumOf(xz), sumOf(yy), sumOf(yz), sumOf(zz)}};
}

inline Bounds boxOf(const Samples& s, uint32_t i, float r) {
    return {{s.x[i] - r, s.y[i] - r, s.z[i] - r}, {s.x[i] + r, s.y[i] + r, s.z[i] + r}};
}
inline void include(const Bounds& other, Bounds& all) {
    for (int a = 0; a < 3; a++) {
        all.low[a] = std::min(all.low[a], other.low[a]);
        all.high[a] = std::max(all.high[a], other.high[a]);
    }
}

constexpr std::size_t kTogether = 8;  // hits that share a search

/** What a search found: near all of some hits, and near one of them. */
struct Neighbors {
    PointList all, own;
};

/** Finds the neighbours of hits that lie near each other together. */
class BallSearch {
 public:
    /** \param range of the largest ball [m] */
    BallSearch(const Samples& hits, const NeighborRows& rows, double range, double resolution)
        : s_(hits), rows_(rows), range_(range), resolution_(resolution) {}

    /** Moments of the smallest ball around each of n hits that holds enough. The hits lie near each
     * other and share a search for all of their balls. */
    AKIMAP_INLINE void moments(const uint32_t* hits, std::size_t n, Neighbors& near,
                               BallMoments* out) const {
        uint32_t pending = (1u << n) - 1;
        for (double radius = std::min(kSmallest * resolution_, range_);;
             radius = std::min(radius * kGrowth, range_)) {
            const auto r = static_cast<float>(radius);
            Bounds around = boxOf(s_, hits[__builtin_ctz(pending)], r);
            for (uint32_t left = pending; left; left &= left - 1)
                include(boxOf(s_, hits[__builtin_ctz(left)], r), around);
            rows_.findPoints(around, near.all);
            for (uint32_t left = pending; left; left &= left - 1) {
                const int k = __builtin_ctz(left);
                const uint32_t i = hits[k];
                near.all.findPoints(boxOf(s_, i, r), near.own);
                out[k] = momentsIn(near.own, s_.x[i], s_.y[i], s_.z[i], r);
                if (out[k].n >= kEnough) pending &= ~(1u << k);
            }
            if (!pending || radius >= range_) return;
        }
    }

    /** How many hits from this place on, at most kTogether, lie near the first. */
    [[nodiscard]] std::size_t together(const uint32_t* hits, std::size_t most) const {
        const Bounds near = boxOf(s_, hits[0], static_cast<float>(2 * kSmallest * resolution_));
        std::size_t n = 1;
        const auto isNear = [&](uint32_t i) {
            return s_.x[i] >= near.low[0] && s_.x[i] <= near.high[0] && s_.y[i] >= near.low[1] &&
                   s_.y[i] <= near.high[1] && s_.z[i] >= near.low[2] && s_.z[i] <= near.high[2];
        };
        while (n < std::min(most, kTogether) && isNear(hits[n])) n++;
        return n;
    }

 private:
    const Samples& s_;
    const NeighborRows& rows_;
    double range_, resolution_;
};

}  // namespace akimap
