// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
// The fixed workload of instructions.sh: the first simulated scans into one map, one thread.
// Usage: bench_instructions surface|paper

#include <cstdio>
#include <string>

#include "scenes.h"

using namespace akimap;

int main(int argc, char** argv) try {
    constexpr std::size_t kScans = 4;
    const std::string estimator = argc == 2 ? argv[1] : "";
    if (estimator != "surface" && estimator != "paper") {
        std::fprintf(stderr, "usage: bench_instructions surface|paper\n");
        return 2;
    }
    const auto scans = app::simulatedRays({});
    AkiMap map;
    map.insertionOptions.threads = 1;
    map.insertionOptions.estimator = estimator == "paper" ? Estimator::paper : Estimator::surface;
    for (std::size_t i = 0; i < kScans; i++) map.insertRays(scans.at(i));
    const InsertionStats& s = map.stats();
    std::printf("samples %llu\n",
                static_cast<unsigned long long>(s.samples_occupied +
                                                (estimator == "paper" ? s.samples_free : 0)));
    return 0;
} catch (const std::exception& e) {
    std::fprintf(stderr, "bench_instructions: %s\n", e.what());
    return 1;
}
