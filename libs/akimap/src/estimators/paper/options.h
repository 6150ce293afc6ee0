// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <akimap/Parameters.h>

#include <array>

namespace akimap {

[[nodiscard]] constexpr auto enumNames(Bandwidth) {
    return std::array{"adaptive", "covariance", "isotropic"};
}
[[nodiscard]] constexpr auto enumNames(SearchRegion) {
    return std::array{"ball", "box"};
}
[[nodiscard]] constexpr auto enumNames(ScaleSearch) {
    return std::array{"exact", "descent"};
}
[[nodiscard]] constexpr auto enumNames(CovarianceCenter) {
    return std::array{"sample", "mean"};
}

/** Calls visit(name, field, comment) for each option. */
template <class Parameters, class Visitor>
void visitPaperFields(Parameters& o, Visitor&& visit) {
    visit("sampling_distance", o.sampling_distance,
          "[m] > 0. paper: one free sample in each such stretch of a ray");
    visit("search_range_origin", o.search_range_origin,
          "[m] >= 0. paper: neighbour search range at the sensor; 0: one cell");
    visit("search_range_max", o.search_range_max,
          "[m] > 0. paper: neighbour search range at max_range; linear in between");
    visit("search_region", o.search_region,
          "paper: box (as printed, and measured better) | ball (the authors' code)");
    visit("covariance_center", o.covariance_center,
          "paper: sample (divided by M - 2) | mean (by M - 1): what the covariance is about");
    visit("covariance_floor", o.covariance_floor,
          "[m^2] >= 0. paper: added to the covariance's diagonal; 0: 0.4 of a cell's face");
    visit("bandwidth", o.bandwidth,
          "paper: adaptive (as printed) | covariance (not scaled by Eq. 7) | isotropic");
    visit("isotropic_length", o.isotropic_length,
          "[m] > 0. paper: support radius of the kernels if bandwidth = isotropic");
    visit("scale_search", o.scale_search,
          "paper: exact | descent (the authors' code): how the kernels' scale, Eq. 7, is found");
    visit("scale_min_length", o.scale_min_length,
          "[m] >= 0. paper: the scale of Eq. 7 leaves the longest semi-axis at least this; 0: one "
          "cell");
    visit("scale_max", o.scale_max, "[-] > 0. paper: upper bound of the kernels' scale, Eq. 7");
    visit("seed", o.seed, "paper: seed of the free samples' random places");
}

/** As the estimator uses them at this cell size [m]: what 0 stands for filled in.
 * The covariance's floor grows with the cell: the thinnest covariance has a semi-axis of 0.63 cells
 * (Eq. 7 may still shrink it), which reaches the centre of the sample's own cell or a neighbour's.
 * At 10 cm the authors' 0.001 m^2 leaves holes. */
[[nodiscard]] PaperParameters paperInForce(PaperParameters p, double resolution);

}  // namespace akimap
