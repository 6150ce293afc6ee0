// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
// Localization in maps of real recordings: the section of BENCHMARK.md by itself.

#include <CLI/CLI.hpp>
#include <cstdio>

#include "report/localizing.h"

using namespace akimap;
using namespace akimap::bench;

int main(int argc, char** argv) try {
    CLI::App app(
        "Looks for held-out scans of rgbd_office and lidar_dense in $AKIMAP_DATA, from wrong "
        "poses, in an AkiMap, a points map and a COctoMap of the others: by ICP and by the "
        "likelihood's maximum.");
    LocalizationRules rules;
    app.add_option("--starts", rules.starts, "In all, as many for each scan")
        ->capture_default_str()
        ->check(CLI::PositiveNumber);
    app.add_option("--seed", rules.seed, "Of the starts")->capture_default_str();
    CLI11_PARSE(app, argc, argv);
    Report report;
    report.doing = [](const std::string& what) { std::fprintf(stderr, "%s\n", what.c_str()); };
    const std::vector<LocalizationCase> cases = localizationCases();
    if (cases.empty())
        throw std::runtime_error("neither rgbd_office nor lidar_dense in $AKIMAP_DATA");
    std::printf("%s", localizationLegend(rules).c_str());
    for (const LocalizationCase& c : cases)
        std::printf("\n%s: %s", c.name.c_str(), localizationSection(report, c, rules).c_str());
    return 0;
} catch (const std::exception& e) {
    std::fprintf(stderr, "bench_localization: %s\n", e.what());
    return 1;
}
