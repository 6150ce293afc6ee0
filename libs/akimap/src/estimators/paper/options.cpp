// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "estimators/paper/options.h"

#include "support/require.h"

namespace akimap {

void PaperParameters::validate() const {
    requirePositive("sampling_distance", sampling_distance);
    requireNonNegative("search_range_origin", search_range_origin);
    requirePositive("search_range_max", search_range_max);
    requireNamed("search_region", search_region);
    requireNamed("covariance_center", covariance_center);
    requireNonNegative("covariance_floor", covariance_floor);
    requireNamed("bandwidth", bandwidth);
    requirePositive("isotropic_length", isotropic_length);
    requireNamed("scale_search", scale_search);
    requireNonNegative("scale_min_length", scale_min_length);
    requirePositive("scale_max", scale_max);
}

PaperParameters paperInForce(PaperParameters p, double resolution) {
    constexpr double kFloor = 0.4;  // of a cell's face
    if (!(p.search_range_origin > 0)) p.search_range_origin = resolution;
    if (!(p.covariance_floor > 0)) p.covariance_floor = kFloor * resolution * resolution;
    if (!(p.scale_min_length > 0)) p.scale_min_length = resolution;
    return p;
}

}  // namespace akimap
