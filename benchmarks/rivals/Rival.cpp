// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "rivals/Rival.h"

#include "grid/BlockGrid.h"

#include <cmath>

namespace akimap::bench {

std::vector<Ray> downsample(const std::vector<Ray>& rays, double size) {
    KeyTable voxels;
    std::vector<Ray> means;
    std::vector<double> counts;
    const auto index = [size](double v) { return static_cast<int32_t>(std::floor(v / size)); };
    for (const Ray& r : rays) {
        const CellIndex voxel{index(r.end[0]), index(r.end[1]), index(r.end[2])};
        const auto [i, is_new] = voxels.insert(packKey(voxel), static_cast<uint32_t>(means.size()));
        if (is_new) means.push_back({}), counts.push_back(0);
        counts[i]++;
        for (std::size_t k = 0; k < 3; k++)
            means[i].origin[k] += r.origin[k], means[i].end[k] += r.end[k];
    }
    for (std::size_t i = 0; i < means.size(); i++)
        for (std::size_t k = 0; k < 3; k++)
            means[i].origin[k] /= counts[i], means[i].end[k] /= counts[i];
    return means;
}

double length(const Ray& r) {
    return std::hypot(r.end[0] - r.origin[0], r.end[1] - r.origin[1], r.end[2] - r.origin[2]);
}

std::array<double, 3> pointOn(const Ray& r, double d) {
    const double l = length(r), t = l > 0 ? d / l : 0;
    return {r.origin[0] + t * (r.end[0] - r.origin[0]), r.origin[1] + t * (r.end[1] - r.origin[1]),
            r.origin[2] + t * (r.end[2] - r.origin[2])};
}

}  // namespace akimap::bench
