// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "NeighborGrid.h"

#include <cmath>

namespace akimap {
namespace {
constexpr double kBinsPerPoint = 16, kFewestBins = 4096;
constexpr std::size_t kPadding = 8;
}  // namespace

void NeighborGrid::chooseBins(const float* const xyz[3], std::size_t n, float bin) {
    double extent[3];
    for (int a = 0; a < 3; a++) {
        const auto [low, high] = std::minmax_element(xyz[a], xyz[a] + n);
        lowest_[a] = *low;
        extent[a] = static_cast<double>(*high) - *low;
    }
    const double most = std::max(kFewestBins, kBinsPerPoint * static_cast<double>(n));
    double side = bin;
    const auto bins = [&](double s) {
        return (extent[0] / s + 1) * (extent[1] / s + 1) * (extent[2] / s + 1);
    };
    while (bins(side) > most) side *= 1.2;
    per_bin_ = static_cast<float>(1 / side);
    for (int a = 0; a < 3; a++) count_[a] = static_cast<int>(extent[a] / side) + 1;
}

void NeighborGrid::build(const float* x, const float* y, const float* z, std::size_t n, float bin) {
    order_.resize(n);
    bin_of_.resize(n);
    for (auto* v : {&x_, &y_, &z_}) v->assign(n + kPadding, 0);
    if (n == 0) return;
    const float* const xyz[3] = {x, y, z};
    chooseBins(xyz, n, bin);

    const auto index = [&](std::size_t i, int a) {
        return std::min(static_cast<int>((xyz[a][i] - lowest_[a]) * per_bin_), count_[a] - 1);
    };
    const std::size_t bins = static_cast<std::size_t>(count_[0]) *
                             static_cast<std::size_t>(count_[1]) *
                             static_cast<std::size_t>(count_[2]);
    start_.assign(bins + 2,
                  0);  // counted two places up, so that placing leaves each begin in place
    for (std::size_t i = 0; i < n; i++) {
        bin_of_[i] = static_cast<uint32_t>((index(i, 2) * count_[1] + index(i, 1)) * count_[0] +
                                           index(i, 0));
        ++start_[bin_of_[i] + 2];
    }
    for (std::size_t b = 2; b < start_.size(); b++) start_[b] += start_[b - 1];
    for (std::size_t i = 0; i < n; i++) {
        const uint32_t place = start_[bin_of_[i] + 1]++;
        order_[place] = static_cast<uint32_t>(i);
        x_[place] = x[i];
        y_[place] = y[i];
        z_[place] = z[i];
    }
}

}  // namespace akimap
