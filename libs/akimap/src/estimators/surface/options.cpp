// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "estimators/surface/options.h"

#include <algorithm>

#include "estimators/surface/FreeBalls.h"
#include "support/require.h"

namespace akimap {

void SurfaceParameters::validate() const {
    requirePositive("surface_range", surface_range);
    requirePositive("free_radius", free_radius);
    requireNonNegative("max_evidence", max_evidence);
    require(max_evidence == 0 || max_evidence >= 1, "max_evidence", max_evidence,
            "0 (none) or at least 1");
}

double freeRadiusInCells(const SurfaceParameters& p, double resolution) {
    return std::clamp(p.free_radius / resolution, 1.5, double{FreeBalls::kMaxRadius});
}

SurfaceParameters surfaceInForce(SurfaceParameters p, double resolution) {
    p.free_radius = freeRadiusInCells(p, resolution) * resolution;
    p.surface_range = std::max(p.surface_range, resolution);
    return p;
}

}  // namespace akimap
