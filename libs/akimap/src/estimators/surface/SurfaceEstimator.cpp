// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "estimators/surface/SurfaceEstimator.h"

#include <algorithm>

#include "estimators/estimators.h"
#include "estimators/surface/free_rays.h"
#include "estimators/surface/options.h"
#include "estimators/surface/patch_fit.h"
#include "support/Stopwatch.h"

namespace akimap {

InsertionParameters SurfaceEstimator::inForce(InsertionParameters p, double resolution) const {
    static_cast<SurfaceParameters&>(p) = surfaceInForce(p, resolution);
    return p;
}

void SurfaceEstimator::check(const InsertionParameters& p, double resolution) const {
    requireReachWithinGrid("surface_range", std::max(p.surface_range, widestPatch(resolution)),
                           resolution);
}

bool SurfaceEstimator::insert(const Scan& scan, const InsertionParameters& p, BlockGrid& grid,
                              InsertionStats& stats) {
    const double resolution = grid.resolution(), radius = freeRadiusInCells(p, resolution);
    Stopwatch watch;
    const KeptRays kept = takeHits(scan.rays, p, grid, taken_, hits_, stats);
    stats.seconds_sampling += watch.lap();
    fitPatches(kept.hits, hits_, p, resolution, rows_, patches_.patches);
    stats.seconds_bandwidth += watch.lap();
    binPatches(patches_);
    const RayMarking marking{resolution, radius, hits_.anchor, patches_, grid};
    markHitRays(marking, kept.hits, free_parts_, free_);
    markBeams(marking, kept.free, free_);
    stats.samples_free += free_.marks();
    free_.transform(radius);
    const bool changed =
        addEvidence(hits_.anchor, patches_, {free_, radius}, p.max_evidence, grid, evidence_);
    stats.seconds_update += watch.lap();
    return changed;
}

}  // namespace akimap
