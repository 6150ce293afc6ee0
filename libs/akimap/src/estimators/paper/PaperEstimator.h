// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <vector>

#include "estimators/ScanEstimator.h"
#include "estimators/kernels/kernel_binning.h"
#include "estimators/paper/bandwidth.h"
#include "grid/BlockUpdate.h"

namespace akimap {

/** The paper's method: samples of both labels, each with a kernel whose bandwidth adapts to its
 * neighbours (Kwon, Moon and Yoon). */
class PaperEstimator : public ScanEstimator {
 public:
    void check(const InsertionParameters& p, double resolution) const override;
    [[nodiscard]] InsertionParameters inForce(InsertionParameters p,
                                              double resolution) const override;
    bool insert(const Scan& scan, const InsertionParameters& p, BlockGrid& grid,
                InsertionStats& stats) override;

 private:
    KeyTable taken_;
    Samples samples_;
    BandwidthWorkspace neighbors_;
    std::vector<Symmetric3> H_;
    BinnedKernels binned_;
    BlockUpdate update_;
};

/** Adds every sample's weighted kernel to the alpha (occupied) or beta (free) of the cells whose
 * centres it reaches, Eq. (8)-(9). Kernels in the samples' order, so the sums are the same for any
 * number of threads; runs in the caller's TBB arena.
 * \return whether any cell gained evidence \exception std::bad_alloc with no sum changed */
bool scatter(const Samples& samples, const std::vector<Symmetric3>& H, BlockGrid& grid,
             BinnedKernels& binned, BlockUpdate& update);

}  // namespace akimap
