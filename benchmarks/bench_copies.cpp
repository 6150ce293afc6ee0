// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
// What a copy of a map costs beside a plain memcpy of its cells: MRPT copies a multi-metric map by
// serializing it, once per particle in rbpf-slam.

#include <mrpt/maps/CMultiMetricMap.h>
#include <sys/mman.h>

#include <cstdio>
#include <cstring>

#include "grid/BlockGrid.h"
#include "scenes.h"
#include "timing.h"

using namespace akimap;
using bench::medianSeconds;

constexpr int kRounds = 9;

int main() {
    auto map = AkiMap::Create();
    for (const auto& scan : bench::simulated(app::SceneKind::structured, 1, 0.1).scans)
        map->insertRays(scan);
    mrpt::maps::CMultiMetricMap maps;
    maps.maps.push_back(map);

    const std::size_t bytes = map->blockCount() * sizeof(Block);
    const std::vector<char> cells(bytes, 1);
    const double warm = medianSeconds(kRounds, [&, copy = std::vector<char>(bytes)]() mutable {
        std::memcpy(copy.data(), cells.data(), bytes);
        return copy[bytes / 2];
    });
    const double fresh = medianSeconds(kRounds, [&] {  // pages that the system has yet to give
        void* copy =
            mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
        std::memcpy(copy, cells.data(), bytes);
        munmap(copy, bytes);
    });
    const auto row = [&](const char* name, double seconds) {
        std::printf("%-40s %8.2f ms  %6.2f x fresh\n", name, 1e3 * seconds, seconds / fresh);
    };
    std::printf("a map of %.1f MB\n", 1e-6 * static_cast<double>(bytes));
    row("memcpy of its cells, warm memory", warm);
    row("memcpy of its cells into fresh memory", fresh);
    row("multi-metric map's copy (bytes)",
        medianSeconds(kRounds, [&] { const mrpt::maps::CMultiMetricMap copy = maps; }));
    row("AkiMap's own copy (shared blocks)",
        medianSeconds(kRounds, [&] { const AkiMap copy = *map; }));
    return 0;
}
