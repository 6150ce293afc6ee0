// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <akimap/AkiMap.h>

#include <cmath>

#include "rays.h"

namespace akimap {

bool AkiMap::internal_canComputeObservationLikelihood(const mrpt::obs::CObservation& obs) const {
    return givesRays(obs);
}

/** End points: each return is explained by the cell it ends in, of occupancy p, or by an outlier.
 * Unknown cells count p_unknown, so that a pose gains nothing by looking past the map's edge. */
double AkiMap::internal_computeObservationLikelihood(const mrpt::obs::CObservation& obs,
                                                     const mrpt::poses::CPose3D& takenFrom) const {
    const LikelihoodParameters& l = likelihoodOptions;
    const auto rays =
        raysOf(obs, [&](mrpt::Clock::time_point) { return std::optional(takenFrom); });
    if (!rays) return 0;
    double log_likelihood = 0;
    for (std::size_t i = 0; i < rays->size(); i += l.decimation) {
        const auto& [origin, end] = (*rays)[i];
        const double range = std::hypot(end[0] - origin[0], end[1] - origin[1], end[2] - origin[2]);
        const bool usable = range > 0 && range >= insertionOptions.min_range &&
                            range <= insertionOptions.max_range;  // false for NaN too
        if (!usable) continue;
        const double p = occupancy(end[0], end[1], end[2]).value_or(l.p_unknown);
        log_likelihood += std::log((1 - l.p_outlier) * p + l.p_outlier);
    }
    return log_likelihood;
}

}  // namespace akimap
