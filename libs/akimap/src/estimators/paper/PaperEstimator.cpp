// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "estimators/paper/PaperEstimator.h"

#include <algorithm>
#include <cmath>

#include "estimators/estimators.h"
#include "estimators/paper/free_samples.h"
#include "estimators/paper/options.h"
#include "support/Stopwatch.h"
#include "support/require.h"

namespace akimap {

InsertionParameters PaperEstimator::inForce(InsertionParameters p, double resolution) const {
    static_cast<PaperParameters&>(p) = paperInForce(p, resolution);
    return p;
}

void PaperEstimator::check(const InsertionParameters& given, double resolution) const {
    const InsertionParameters p = inForce(given, resolution);
    require(p.max_range / p.sampling_distance < 1e6, "sampling_distance", p.sampling_distance,
            "at least a millionth of max_range");
    const double scale = std::max(1.0, p.scale_max);
    // A covariance about the sample, over M - 2 with M = 3, is twice the square of the range on
    // each axis.
    const double range = std::sqrt(2.0) * std::max(p.search_range_max, p.search_range_origin);
    requireReachWithinGrid("search_range_max, search_range_origin and scale_max", scale * range,
                           resolution);
    requireReachWithinGrid("covariance_floor and scale_max", scale * std::sqrt(p.covariance_floor),
                           resolution);
    requireReachWithinGrid("isotropic_length", p.isotropic_length, resolution);
}

bool PaperEstimator::insert(const Scan& scan, const InsertionParameters& p, BlockGrid& grid,
                            InsertionStats& stats) {
    Stopwatch watch;
    takeSamples(scan.rays, p, grid, scan.number, w_.taken, w_.samples, stats);
    stats.seconds_sampling += watch.lap();
    bandwidths(w_.samples, p, grid.resolution(), w_.neighbors, w_.H);
    stats.seconds_bandwidth += watch.lap();
    const bool changed = scatter(w_, grid);
    stats.seconds_update += watch.lap();
    return changed;
}

bool scatter(PaperWorkspace& w, BlockGrid& grid) {
    binKernels(w.samples, w.H, grid.resolution(), w.kernels);
    const auto placeOf = [&](std::size_t b) {
        return blockInMap(w.kernels.keys[b], w.samples.anchor);
    };
    const auto add = [&](std::size_t b, Block& block) {
        const bool reached =
            addKernels(w.kernels, b, w.samples.occupied, block.alpha.data(), block.beta.data());
        return reached && !block.isEmpty();  // a kernel's edge may round to nothing
    };
    return w.update.run(grid, w.kernels.keys.size(), placeOf, add);
}

}  // namespace akimap
