// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <vector>

#include "estimators/ScanEstimator.h"
#include "estimators/kernels/kernel_binning.h"
#include "estimators/paper/bandwidth.h"
#include "grid/BlockUpdate.h"

namespace akimap {

/** Buffers of the paper's method, kept between scans. */
struct PaperWorkspace {
    KeyTable taken;
    Samples samples;
    BandwidthWorkspace neighbors;
    std::vector<Symmetric3> H;  ///< [m^2] of the samples
    BinnedKernels kernels;
    BlockUpdate update;
};

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
    PaperWorkspace w_;
};

/** Adds the weighted kernel of every sample of the workspace to the alpha (occupied) or beta (free)
 * of the cells whose centres it reaches, Eq. (8)-(9). Kernels in the samples' order, so the sums
 * are the same for any number of threads; runs in the caller's TBB arena. \return whether any cell
 * gained evidence \exception std::bad_alloc with no sum changed */
bool scatter(PaperWorkspace& workspace, BlockGrid& grid);

}  // namespace akimap
