// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <akimap/Ray.h>

#include <cstddef>
#include <vector>

namespace akimap::bench {

struct ResidualOptions {
    double cone = 0.025;          ///< [rad] > 0. Neighbours are the returns so close in direction
    double max_incidence = 1.05;  ///< [rad] between ray and normal; flatter patches are left out
    std::size_t min_returns = 12;
    std::size_t patches = 1500;                            ///< at most so many a scan, evenly
    std::vector<double> edges{1, 1.5, 2, 2.5, 3, 3.5, 4};  ///< [m] bins of range, in order
};

/** The patches of one bin of range. */
struct ResidualBin {
    double from, to;                  ///< [m]
    std::size_t patches;              ///< flat or not
    double residual, lower_quartile;  ///< [m] over the patches; NaN if there are none
};

/** How noisy a sensor's ranges are, told from its scans alone: around returns all over each scan a
 * plane is fitted (least squares across the plane) to the returns of that scan that are close in
 * direction. The patch's residual is the standard deviation along the rays, with the three degrees
 * of freedom of the plane counted. A bin's is the median over its patches, which those that bend or
 * have an edge in them do not move much.
 * The lower quartile is of the flattest patches: to compare rooms of more and of less furniture.
 * \param scans  each of one or more origins [m]; non-finite rays are skipped
 * \exception std::invalid_argument unless there are two edges or more, in order */
[[nodiscard]] std::vector<ResidualBin> planeResiduals(const std::vector<std::vector<Ray>>& scans,
                                                      const ResidualOptions& options);

}  // namespace akimap::bench
