// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
// Do maps predict what the next scan sees? The real recordings of BENCHMARK.md, one by one.

#include <CLI/CLI.hpp>
#include <cstdio>

#include "report/predictions.h"

using namespace akimap;
using namespace akimap::bench;

int main(int argc, char** argv) try {
    CLI::App app("Judges maps by held-out scans of the recordings in $AKIMAP_DATA.");
    std::string only, folds = "all";
    unsigned threads = 1;
    app.add_option("only", only, "Those whose names contain this");
    app.add_option("--folds", folds, "all: each scan is held out once; one: scans 5, 10, ...")
        ->capture_default_str()
        ->check(CLI::IsMember({"all", "one"}));
    app.add_option("--threads", threads, "Of AkiMap; 0: all cores")->capture_default_str();
    CLI11_PARSE(app, argc, argv);
    Report report;
    report.doing = [](const std::string& what) { std::fprintf(stderr, "%s\n", what.c_str()); };
    for (Trial& trial : realTrials()) {
        if (trial.name.find(only) == std::string::npos) continue;
        const auto scans = trial.scans();
        if (scans.empty()) {
            std::fprintf(stderr, "%s: not there, left out\n", trial.name.c_str());
            continue;
        }
        trial.all_folds = folds == "all";
        const auto result = hold(trial, scans, report.doing, threads);
        std::printf("%s: %s\n", trial.name.c_str(),
                    predictionTables(report, trial.name, result).c_str());
        std::fflush(stdout);
    }
    return 0;
} catch (const std::exception& e) {
    std::fprintf(stderr, "bench_next_scan: %s\n", e.what());
    return 1;
}
