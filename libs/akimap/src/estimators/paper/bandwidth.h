// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <tbb/enumerable_thread_specific.h>

#include <vector>

#include "estimators/hits.h"
#include "estimators/paper/scale.h"
#include "numeric/Ldlt.h"
#include "numeric/NeighborRows.h"

namespace akimap {

/** Buffers of one thread. */
struct SelectorScratch {
    PointList same, other;    ///< points of either label near eight samples
    std::vector<float> hits;  ///< squared distances of those in a sample's support
    ScaleProblem problem;
    uint64_t tested = 0;  ///< points tested against the regions of eight samples, since the start
};

/** Buffers of the bandwidth stage, kept between scans. */
struct NeighborScratch {
    NeighborRows occupied, free;
    tbb::enumerable_thread_specific<SelectorScratch> per_thread;
};

/** Room 3: the bandwidth matrix H [m^2] of each sample (paper, Sec. IV-C), by the first stage
 * (covariance of the neighbours of the same label) and the second (its scale, Eq. 7).
 * The same for any number of threads; runs in the caller's TBB arena. */
void bandwidths(const Samples& samples, const InsertionParameters& parameters, double resolution,
                NeighborScratch& scratch, std::vector<Symmetric3>& H);

/** What is added to the covariance's diagonal [m^2]. Without an option it grows with the cell: the
 * thinnest covariance has a semi-axis of 0.63 cells (Eq. 7 may still shrink it), which reaches the
 * centre of the sample's own cell or a neighbour's. At 10 cm the authors' 0.001 m^2 leaves holes.
 */
[[nodiscard]] double covarianceFloor(const InsertionParameters& p, double resolution);

/** Radius (ball) or half side (box) [m] of the region in which the neighbours of a sample at this
 * distance [m] from its ray origin are sought: linear, from search_range_origin at the sensor to
 * search_range_max at max_range. */
[[nodiscard]] float searchRange(const InsertionParameters& p, double resolution, float distance);

}  // namespace akimap
