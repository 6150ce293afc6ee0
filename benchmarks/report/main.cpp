// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
// Measures everything that BENCHMARK.md tells, and writes it with its pictures.

#include <mrpt/system/CTicTac.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>

#include "report/contents.h"
#include "report/markdown.h"
#include "support/AtomicFile.h"

using namespace akimap;
using namespace akimap::bench;

namespace {

struct Request {
    std::string output = "BENCHMARK.md", pictures = "doc/pictures", commit = "unknown",
                command = "make benchmark";
    int seeds = 5;
};

void run(const Request& request) {
    mrpt::system::CTicTac clock;
    std::filesystem::create_directories(request.pictures);
    Report report;
    report.pictures = request.pictures, report.seeds = request.seeds;
    report.pictures_link =
        std::filesystem::relative(request.pictures,
                                  std::filesystem::absolute(request.output).parent_path())
            .string();
    report.doing = [&](const std::string& what) {
        std::printf("[%5.0f s] %s\n", clock.Tac(), what.c_str());
        std::fflush(stdout);
    };
    const std::string body = bodyOf(report, standardContents(request.seeds));
    const std::string head =
        "# Benchmark\n\nWritten by `" + request.command + "` at commit " + request.commit + ": " +
        describeMachine() +
        ". Do not edit: every figure but the paper's own is measured by that command. Best figures "
        "are bold. The recordings are made by benchmarks/data.sh.\n" +
        openingOf(report);

    writeWhole(request.output, head + body);
    std::printf("[%5.0f s] %s and its pictures in %s are written\n", clock.Tac(),
                request.output.c_str(), request.pictures.c_str());
}

}  // namespace

int main(int argc, char** argv) try {
    CLI::App app(
        "Measures AkiMap beside other maps, and writes BENCHMARK.md and its pictures; some 20 "
        "minutes of two cores. Recordings are those in $AKIMAP_DATA (benchmarks/data.sh makes "
        "them) and LA3DM's in $LA3DM_DIR, by default $AKIMAP_DATA/la3dm; what is not there is left "
        "out.");
    Request request;
    app.add_option("-o,--output", request.output, "The report")->capture_default_str();
    app.add_option("--pictures", request.pictures, "Folder for them")->capture_default_str();
    app.add_option("--seeds", request.seeds, "Recordings, or runs of random methods, to average")
        ->capture_default_str()
        ->check(CLI::PositiveNumber);
    app.add_option("--commit", request.commit, "Named in the report")->capture_default_str();
    CLI11_PARSE(app, argc, argv);
    run(request);
    return 0;
} catch (const std::exception& e) {
    std::fprintf(stderr, "benchmark_report: %s\n", e.what());
    return 1;
}
