// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <akimap/InsertionStats.h>
#include <akimap/Parameters.h>
#include <akimap/Ray.h>

#include <vector>

#include "grid/BlockGrid.h"

namespace akimap {

/** One scan, as an estimator gets it: whole. */
struct Scan {
    const std::vector<Ray>& rays;  ///< [m] map frame; unusable ones are skipped and counted
    uint64_t number;               ///< stored with the map; all randomness follows from it
};

/** How a scan becomes evidence. An estimator keeps its workspace between scans and nothing else:
 * the locality contract of doc/architecture.md. One thread at a time. */
class ScanEstimator {
 public:
    virtual ~ScanEstimator() = default;
    ScanEstimator() = default;
    ScanEstimator(const ScanEstimator&) = delete;
    ScanEstimator& operator=(const ScanEstimator&) = delete;

    /** \exception std::invalid_argument naming an option whose value does not go with this cell
     * size [m], or would let a kernel reach farther than kMaxKernelCells */
    virtual void check(const InsertionParameters& p, double resolution) const = 0;
    /** The options as they are used at this cell size [m]. */
    [[nodiscard]] virtual InsertionParameters inForce(InsertionParameters p,
                                                      double resolution) const = 0;
    /** Adds the scan to the grid. The same sums for any number of threads; runs in the caller's TBB
     * arena. \param p valid, and checked \return whether any cell gained evidence
     * \exception std::bad_alloc with no sum changed */
    virtual bool insert(const Scan& scan, const InsertionParameters& p, BlockGrid& grid,
                        InsertionStats& stats) = 0;
};

}  // namespace akimap
