// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <vector>

namespace akimap {

/** The neighbours of a sample inside its kernel's initial support, as squared distances u in
 * the metric of its covariance. */
struct SupportNeighbors {
    std::vector<float> positive, negative;
};

/** Sum of Eq. (7) at length scale s (H = s^2 * covariance), up to the constant factor
 * |covariance|^(-1/2) / 2. */
[[nodiscard]] double scaleObjective(const SupportNeighbors& n, double s);

/** The length scale in [lowest, highest] that minimises Eq. (7): the best of a fixed set of
 * candidates, polished by golden-section search between its neighbours. */
[[nodiscard]] double bestScale(const SupportNeighbors& n, double lowest, double highest);

}  // namespace akimap
