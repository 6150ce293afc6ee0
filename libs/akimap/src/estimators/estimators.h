// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <memory>

#include "estimators/ScanEstimator.h"

namespace akimap {

/** \pre one of the named values */
[[nodiscard]] std::unique_ptr<ScanEstimator> makeEstimator(Estimator estimator);

/** Validates the options and has the estimator add the scan, on so many threads as they ask for.
 * \return whether any cell gained evidence
 * \exception std::invalid_argument naming the option, std::bad_alloc; the grid's sums and the
 * statistics are unchanged then */
bool insertScan(ScanEstimator& estimator, const Scan& scan, const InsertionParameters& parameters,
                BlockGrid& grid, InsertionStats& stats);

/** \exception std::invalid_argument naming what `name` says, if kernels could reach so far [m] */
void requireReachWithinGrid(const char* name, double reach, double resolution);

}  // namespace akimap
