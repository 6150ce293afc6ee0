// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "rivals/BgkLOctoMap.h"

#include <algorithm>

namespace akimap::bench {

BgkOptions BgkLOctoMap::defaults() {
    BgkOptions o;
    o.kernel_variance = 0.1, o.free_step = 0.3;
    o.variance_threshold = 0.15, o.min_evidence = 0.001;
    return o;
}

void BgkLOctoMap::insert(const std::vector<Ray>& scan) {
    std::vector<std::array<double, 3>> places;
    for (const Ray& r : downsample(scan, options_.downsampling)) {
        const double l = length(r);
        if (l > options_.max_range) continue;
        blocks_.add({r.end, r.end, true}, {r.end});
        places.clear();
        for (int i = 1; l - i * options_.free_step > 0; i++)
            places.push_back(pointOn(r, l - i * options_.free_step));
        places.push_back(r.origin);
        const auto end = places.front();  // the origin of a ray shorter than free_step
        blocks_.add({r.origin, end, false}, places);
    }
    blocks_.update();
}

}  // namespace akimap::bench
