// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "estimators/surface/SurfaceEstimator.h"

#include <tbb/parallel_invoke.h>

#include "estimators/estimators.h"
#include "estimators/surface/options.h"
#include "support/Stopwatch.h"

namespace akimap {

InsertionParameters SurfaceEstimator::inForce(InsertionParameters p, double resolution) const {
    static_cast<SurfaceParameters&>(p) = surfaceInForce(p, resolution);
    return p;
}

void SurfaceEstimator::check(const InsertionParameters& p, double resolution) const {
    requireReachWithinGrid("surface_range", widestKernel(p, resolution), resolution);
}

bool SurfaceEstimator::insert(const Scan& scan, const InsertionParameters& p, BlockGrid& grid,
                              InsertionStats& stats) {
    const double resolution = grid.resolution(), radius = freeRadiusInCells(p, resolution);
    Stopwatch watch;
    const KeptRays kept = takeHits(scan.rays, p, grid, taken_, hits_, stats);
    stats.seconds_sampling += watch.lap();
    fitHitPlanes(kept.hits, hits_, p, resolution, fit_, planes_, H_);
    stats.seconds_bandwidth += watch.lap();
    tbb::parallel_invoke(
        [&] {
            stats.samples_free += markHitRays(kept.hits, planes_, radius, resolution, hits_.anchor,
                                              free_parts_, free_);
            stats.samples_free += markBeams(kept.free, radius, resolution, hits_.anchor, free_);
            free_.transform(radius);
        },
        [&] { binKernels(hits_, H_, resolution, kernels_, KernelWeight::one); });
    const bool changed =
        addEvidence(hits_.anchor, kernels_, {free_, radius}, p.max_evidence, grid, evidence_);
    stats.seconds_update += watch.lap();
    return changed;
}

}  // namespace akimap
