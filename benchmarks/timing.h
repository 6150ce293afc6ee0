// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <mrpt/system/CTicTac.h>

#include <algorithm>
#include <ctime>
#include <vector>

namespace akimap::bench {

[[nodiscard]] inline double median(std::vector<double> v) {
    std::sort(v.begin(), v.end());
    return v[v.size() / 2];
}

template <class Work>
[[nodiscard]] double seconds(Work&& work) {
    mrpt::system::CTicTac clock;
    work();
    return clock.Tac();
}

template <class Work>
[[nodiscard]] double medianSeconds(int rounds, Work&& work) {
    std::vector<double> times;
    for (int i = 0; i < rounds; i++) times.push_back(seconds(work));
    return median(times);
}

/** Of all threads of this process: what other programs on the machine do hardly counts. */
template <class Work>
[[nodiscard]] double medianCpuSeconds(int rounds, Work&& work) {
    std::vector<double> times;
    for (int i = 0; i < rounds; i++) {
        const std::clock_t start = std::clock();
        work();
        times.push_back(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
    }
    return median(times);
}

}  // namespace akimap::bench
