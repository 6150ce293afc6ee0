// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include "rivals/BgkBlocks.h"
#include "rivals/Rival.h"

namespace akimap::bench {

/** BGKOctoMap-L (Doherty, Shan, Wang, Englot, T-RO 2019): free space is the line segment from the
 * sensor to free_step before the hit. As in LA3DM, a block takes the segments that have a place in
 * it: the sensor, or a multiple of free_step before the hit. */
class BgkLOctoMap : public Rival {
 public:
    explicit BgkLOctoMap(const BgkOptions& options = defaults())
        : options_(options), blocks_(options) {}
    /** LA3DM's for 5 cm cells. */
    [[nodiscard]] static BgkOptions defaults();

    void insert(const std::vector<Ray>& scan) override;
    [[nodiscard]] std::optional<double> occupancy(double x, double y, double z) const override {
        return blocks_.occupancy(x, y, z);
    }

 private:
    BgkOptions options_;
    BgkBlocks blocks_;
};

}  // namespace akimap::bench
