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

bool PaperEstimator::insert(const Scan& scan, const InsertionParameters& given, BlockGrid& grid,
                            InsertionStats& stats) {
    const InsertionParameters p = inForce(given, grid.resolution());
    Stopwatch watch;
    takeSamples(scan.rays, p, grid, scan.number, taken_, samples_, stats);
    stats.seconds_sampling += watch.lap();
    bandwidths(samples_, p, grid.resolution(), neighbors_, H_);
    stats.seconds_bandwidth += watch.lap();
    const bool changed = scatter(samples_, H_, grid, binned_, update_);
    stats.seconds_update += watch.lap();
    return changed;
}

bool scatter(const Samples& samples, const std::vector<Symmetric3>& H, BlockGrid& grid,
             BinnedKernels& binned, BlockUpdate& update) {
    binKernels(samples, H, grid.resolution(), binned, KernelWeight::density);
    const auto placeOf = [&](std::size_t b) { return blockInMap(binned.keys[b], samples.anchor); };
    return update.run(grid, binned.keys.size(), placeOf,
                      [&](std::size_t b, Block& block, bool fresh) {
                          if (fresh) block.alpha.fill(0), block.beta.fill(0);
                          return addKernels(binned, b, samples.occupied, block.alpha.data(),
                                            block.beta.data());
                      });
}

}  // namespace akimap
