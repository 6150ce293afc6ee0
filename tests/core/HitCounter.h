// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include "estimators/ScanEstimator.h"
#include "estimators/hits.h"
#include "grid/BlockGrid.h"
#include "grid/BlockUpdate.h"

namespace akimap::test {

/** A third estimator, as small as one can be: each hit adds `weight` to its cell. What a new one
 * needs beside its own folder: a name in Parameters.h and estimators/options.h, and one line in
 * estimators.cpp. */
class HitCounter : public ScanEstimator {
 public:
    explicit HitCounter(float weight) : weight_(weight) {}
    void check(const InsertionParameters& p, double resolution) const override;
    [[nodiscard]] InsertionParameters inForce(InsertionParameters p, double) const override {
        return p;
    }
    bool insert(const Scan& scan, const InsertionParameters& p, BlockGrid& grid,
                InsertionStats& stats) override;

 private:
    float weight_;
    KeyTable taken_;
    Samples hits_;
    BlockUpdate update_;
};

}  // namespace akimap::test
