// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <vector>

#include "estimators/ScanEstimator.h"
#include "estimators/surface/evidence.h"
#include "numeric/NeighborRows.h"

namespace akimap {

/** The default: surfaces fitted to the hits, and free space around the rays (doc/design.md). */
class SurfaceEstimator : public ScanEstimator {
 public:
    void check(const InsertionParameters& p, double resolution) const override;
    [[nodiscard]] InsertionParameters inForce(InsertionParameters p,
                                              double resolution) const override;
    bool insert(const Scan& scan, const InsertionParameters& p, BlockGrid& grid,
                InsertionStats& stats) override;

 private:
    KeyTable taken_;
    Samples hits_;
    NeighborRows rows_;
    BinnedPatches patches_;
    FreeBalls free_;
    std::vector<FreeBalls> free_parts_;  // one a thread
    EvidenceWorkspace evidence_;
};

}  // namespace akimap
