// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
// Someone walks through a simulated room: how many cells of them stay in the maps, and how long.

#include <CLI/CLI.hpp>
#include <cstdio>

#include "report/moving.h"

using namespace akimap;
using namespace akimap::bench;

int main(int argc, char** argv) try {
    CLI::App app(
        "Someone crosses a simulated room before a standing robot and stops halfway. Cells that "
        "the "
        "map holds for occupied where they are and, while they are there and later, where they "
        "were; and for cells that were occupied when they were left, the scans until they are "
        "free.");
    double resolution = 0.05;
    uint64_t seed = 1;
    app.add_option("--resolution", resolution, "Side of a cell [m]")
        ->capture_default_str()
        ->check(CLI::Range(0.01, 1.0));
    app.add_option("--seed", seed, "Of the sensors' errors")->capture_default_str();
    CLI11_PARSE(app, argc, argv);
    Report report;
    report.doing = [](const std::string& what) { std::fprintf(stderr, "%s\n", what.c_str()); };
    const std::pair<const char*, app::SensorKind> sensors[] = {{"kinect", app::SensorKind::kinect},
                                                               {"vlp16", app::SensorKind::vlp16}};
    for (const auto& [name, kind] : sensors) {
        const WatchedWalk walk = simulatedWalk(kind, name, seed, resolution);
        std::printf("%s, %zu scans, %g m cells\n%s\n", name, walk.scans.size(), resolution,
                    movingSection(report, walk).c_str());
    }
    return 0;
} catch (const std::exception& e) {
    std::fprintf(stderr, "bench_moving: %s\n", e.what());
    return 1;
}
