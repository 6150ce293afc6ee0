// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <akimap/Parameters.h>
#include <tbb/enumerable_thread_specific.h>

#include <vector>

#include "estimators/Samples.h"
#include "estimators/paper/scale.h"
#include "numeric/Ldlt.h"
#include "numeric/NeighborRows.h"

namespace akimap {

/** Buffers of one thread. */
struct SelectorWorkspace {
    PointList same, other;    ///< points of either label near eight samples
    std::vector<float> hits;  ///< squared distances of those in a sample's support
    ScaleProblem problem;
    uint64_t tested = 0;  ///< points tested against the regions of eight samples, since the start
};

/** Buffers of the bandwidth stage, kept between scans. */
struct BandwidthWorkspace {
    NeighborRows occupied, free;
    tbb::enumerable_thread_specific<SelectorWorkspace> per_thread;
};

/** The bandwidth matrix H [m^2] of each sample (paper, Sec. IV-C), by the first stage
 * (covariance of the neighbours of the same label) and the second (its scale, Eq. 7).
 * The same for any number of threads; runs in the caller's TBB arena. */
void bandwidths(const Samples& samples, const InsertionParameters& parameters, double resolution,
                BandwidthWorkspace& scratch, std::vector<Symmetric3>& H);

/** Radius (ball) or half side (box) [m] of the region in which the neighbours of a sample at this
 * distance [m] from its ray origin are sought: linear, from search_range_origin at the sensor to
 * search_range_max at max_range. \param p in force, see paperInForce() */
[[nodiscard]] float searchRange(const InsertionParameters& p, float distance);

}  // namespace akimap
