// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <akimap/Parameters.h>
#include <akimap/Ray.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "queries/MapView.h"

namespace akimap {

/** How well the map explains returns: a beam model of the stretch of each ray about its end.
 * The beam meets the cells one after another, is stopped in each with the cell's occupancy, and a
 * stop at distance d from the measured end weighs exp(-d^2 / 2 sigma^2). Unknown cells stop
 * nothing; a beam that gets to a measured end in an unknown cell has p_unknown there.
 * One for each thread: it remembers the last block. */
class HitModel {
 public:
    HitModel(const MapView& map, const LikelihoodParameters& parameters)
        : grid_(map.grid),
          prior_(map.prior),
          per_meter_(kUnit / grid_.resolution()),
          p_unknown_(parameters.p_unknown) {
        const double sigma = parameters.sigma_hit / grid_.resolution();  // [cells]
        reach_ = static_cast<int>(std::min<double>(kMostReach, std::floor(kSigmas * sigma)));
        for (int k = 0; k <= reach_; k++)
            weights_[static_cast<std::size_t>(k)] =
                k ? std::exp(-0.5 * (k / sigma) * (k / sigma)) : 1.0;
    }

    /** In [0, 1]: 0 in free space, 1 on a certain surface. \param range  [m] the ray's length, > 0
     */
    [[nodiscard]] double hit(const Ray& ray, double range) {
        if (!grid_.covers(ray.end[0], ray.end[1], ray.end[2])) return p_unknown_;
        const double per_step = kUnit / range;
        Fixed at, step;
        for (std::size_t a = 0; a < 3; a++) {
            step[a] = static_cast<int64_t>((ray.end[a] - ray.origin[a]) * per_step);
            at[a] = static_cast<int64_t>(ray.end[a] * per_meter_) - reach_ * step[a];
        }
        double through = 1, hit = 0;
        for (int k = -reach_; k <= reach_ && through > kStopped; k++) {
            const double p = occupancy(cellOf(at));
            if (p > 0) {
                hit += through * p * weights_[static_cast<std::size_t>(std::abs(k))];
                through *= 1 - p;
            } else if (k == 0 && p < 0) {
                hit += through * p_unknown_, through *= 1 - p_unknown_;
            }
            for (std::size_t a = 0; a < 3; a++) at[a] += step[a];
        }
        return hit;
    }

 private:
    static constexpr int kMostReach = 16;    ///< [cells] each way
    static constexpr double kSigmas = 1.75;  ///< where a weight falls to 0.22
    static constexpr double kStopped = 1e-3;

    /** Coordinates in 2^-20 cells: stepping and flooring are additions and shifts. */
    using Fixed = std::array<int64_t, 3>;
    static constexpr int kBits = 20;
    static constexpr double kUnit = 1 << kBits;
    [[nodiscard]] static CellIndex cellOf(const Fixed& v) {
        return {static_cast<int32_t>(v[0] >> kBits), static_cast<int32_t>(v[1] >> kBits),
                static_cast<int32_t>(v[2] >> kBits)};
    }
    /** Eq. (4), or -1 where nothing is known; 0 where nothing but the prior speaks for occupied. */
    [[nodiscard]] double occupancy(const CellIndex& c) {
        const CellIndex b = BlockGrid::blockOf(c);
        if (!(b == block_index_)) block_index_ = b, block_ = grid_.find(b);
        if (!block_) return -1;
        const auto i = static_cast<std::size_t>(BlockGrid::offsetOf(c));
        const float alpha = block_->alpha[i], beta = block_->beta[i];
        if (!(alpha > 0)) return beta > 0 ? 0 : -1;
        const double a = static_cast<double>(alpha) + prior_.alpha;
        return a / (a + static_cast<double>(beta) + prior_.beta);
    }

    const BlockGrid& grid_;
    Prior prior_;
    double per_meter_, p_unknown_;
    int reach_ = 0;
    std::array<double, kMostReach + 1> weights_{};
    CellIndex block_index_{INT32_MAX, 0, 0};
    const Block* block_ = nullptr;
};

}  // namespace akimap
