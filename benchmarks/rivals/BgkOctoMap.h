// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include "rivals/BgkBlocks.h"
#include "rivals/Rival.h"

namespace akimap::bench {

/** BGKOctoMap (Doherty, Wang, Englot, ICRA 2017): Bayesian generalized kernel inference from hits
 * and from free points along the rays, both thinned. Defaults: LA3DM's for 5 cm cells. */
class BgkOctoMap : public Rival {
 public:
    explicit BgkOctoMap(const BgkOptions& options = {}) : options_(options), blocks_(options) {}
    void insert(const std::vector<Ray>& scan) override;
    [[nodiscard]] std::optional<double> occupancy(double x, double y, double z) const override {
        return blocks_.occupancy(x, y, z);
    }

 private:
    BgkOptions options_;
    BgkBlocks blocks_;
};

}  // namespace akimap::bench
