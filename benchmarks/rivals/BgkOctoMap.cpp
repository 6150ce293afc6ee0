// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "rivals/BgkOctoMap.h"

namespace akimap::bench {

void BgkOctoMap::insert(const std::vector<Ray>& scan) {
    const double step = options_.free_step;
    std::vector<Ray> free;  // only their ends count
    for (const Ray& r : downsample(scan, options_.downsampling)) {
        const double l = length(r);
        if (l > options_.max_range) continue;
        blocks_.add({r.end, r.end, true}, {r.end});
        free.push_back({r.origin, r.origin});
        for (int i = 1; i * step < l; i++) free.push_back({r.origin, pointOn(r, i * step)});
        if (l > step) free.push_back({r.origin, pointOn(r, l - step)});
    }
    for (const Ray& r : downsample(free, options_.downsampling))
        blocks_.add({r.end, r.end, false}, {r.end});
    blocks_.update();
}

}  // namespace akimap::bench
