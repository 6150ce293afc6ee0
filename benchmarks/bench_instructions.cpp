// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
// The fixed workload of instructions.sh: the first simulated scans into one map, one thread.

#include <cstdio>

#include "scenes.h"

using namespace akimap;

int main() try {
    constexpr std::size_t kScans = 4;
    const auto scans = app::simulatedRays({});
    AkiMap map;
    map.insertionOptions.threads = 1;
    for (std::size_t i = 0; i < kScans; i++) map.insertRays(scans.at(i));
    std::printf("samples %llu\n", static_cast<unsigned long long>(map.stats().samples_occupied +
                                                                  map.stats().samples_free));
    return 0;
} catch (const std::exception& e) {
    std::fprintf(stderr, "bench_instructions: %s\n", e.what());
    return 1;
}
