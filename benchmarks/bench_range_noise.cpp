// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
// How noisy a sensor's ranges are, by range, told from recordings alone: real ones and those of
// `akimap simulate` by the same measure.

#include <CLI/CLI.hpp>
#include <cstdio>

#include "plane_residuals.h"
#include "scenes.h"

using namespace akimap;
using namespace akimap::bench;

int main(int argc, char** argv) try {
    CLI::App app(
        "Fits planes to patches of each scan and tells by range how far its returns lie from them, "
        "along the rays: standard deviation of a patch, median and lower quartile over the "
        "patches.");
    app::InputRequest inputs;
    ResidualOptions options;
    app::addInputOptions(app, inputs);
    app.add_option("--cone", options.cone, "[rad] A patch: the returns so close in direction")
        ->capture_default_str()
        ->check(CLI::PositiveNumber);
    app.add_option("--bins", options.edges, "[m] Edges of the bins of range, in order")
        ->capture_default_str()
        ->delimiter(',')
        ->expected(2, 50);
    CLI11_PARSE(app, argc, argv);
    const Scene scene = scansOf("", inputs);
    const auto bins = planeResiduals(scene.scans, options);
    std::printf("%zu scans\nrange [m]        patches   residual [mm]   lower quartile [mm]\n",
                scene.scans.size());
    for (const ResidualBin& bin : bins)
        std::printf("%5.2f to %5.2f %10zu %15.1f %21.1f\n", bin.from, bin.to, bin.patches,
                    1e3 * bin.residual, 1e3 * bin.lower_quartile);
    return 0;
} catch (const std::exception& e) {
    std::fprintf(stderr, "bench_range_noise: %s\n", e.what());
    return 1;
}
