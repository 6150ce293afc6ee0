// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
// Measures everything that BENCHMARK.md tells, and writes it with its pictures.

#include <mrpt/system/CTicTac.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "report/accuracy.h"
#include "report/equal_time.h"
#include "report/heldout.h"
#include "report/markdown.h"
#include "report/on_the_fly.h"
#include "report/places.h"
#include "support/AtomicFile.h"

using namespace akimap;
using namespace akimap::bench;

namespace {

struct Request {
    std::string output = "BENCHMARK.md", pictures = "doc/pictures", commit = "unknown",
                command = "make benchmark";
    int seeds = 10;
    app::InputRequest own;
};

std::string heading(const std::string& text) {
    return "\n## " + text + "\n\n";
}

void accuracy(Report& report, const std::vector<Place>& places, std::ostream& out) {
    out << heading("Against a known truth") << "5 cm cells, returns within " << kMaxRange
        << " m unless said otherwise, one thread. σ: the largest standard deviation of a row's "
           "figures over its runs; a run is a recording or, where there is only one, a seed of the "
           "method, of slow methods only three. `known`: the cells that the map has evidence for, "
           "to which precision and recall belong too; `all`: every cell of known truth, p = 0.5 "
           "without evidence. Time is insertion only, median. Pictures are of the first run; "
           "close-ups show a piece of a wall and of the floor from one viewpoint, each cell's "
           "colour telling what the map says of it beside the truth.\n";
    for (const Place& place : places) {
        out << "\n### " << place.name << "\n\n" << place.what << "\n\n";
        if (place.file == "la3dm") out << paperTable() << "\nHere:\n\n";
        out << accuracySection(report, place);
    }
    out << "\nThe rows:\n\n";
    for (const auto& methods : {akimapMethods(), otherMethods()})
        for (const Method& m : methods) out << "- " << m.name << ": " << m.what << "\n";
}

void equalTime(Report& report, const Scene& scene, const std::string& name, std::ostream& out) {
    out << heading("At equal time (the paper's Fig. 4)") << scene.name
        << ", one thread. In brackets: the share of the returns, in steps of 5 %, whose insertion "
           "fits the budget; 5 % where not even that does.\n\n"
        << equalTimeSection(report, scene, name);
}

void heldOut(Report& report, const std::vector<std::pair<std::string, Scene>>& scenes,
             std::ostream& out) {
    out << heading("Without a truth: scans that the maps never got")
        << "Every fifth scan is held out. Its returns should be occupied, and what its rays passed "
           "free: one place per 0.5 m up to 0.2 m before the return. `known`: the places that the "
           "map has evidence for. Log-loss: p clamped to [0.01, 0.99]; ECE: expected calibration "
           "error, ten bins.\n";
    for (const auto& [name, scene] : scenes)
        out << "\n### " << scene.name << "\n\n" << heldOutSection(report, scene, name);
}

void onTheFly(Report& report, std::ostream& out) {
    out << heading("On the fly")
        << "Simulated lidars in a room, 10 Hz, 5 cm cells, 10 m range. A scan is lost if it comes "
           "during an update, by a virtual clock.\n";
    const std::pair<const char*, LidarModel> lidars[] = {{"lidar", sixteenBeams()},
                                                         {"dense_lidar", denseLidar()}};
    for (const auto& [name, model] : lidars) {
        report.doing(model.name + ": scans");
        const LidarDrive drive = simulatedLidar(100, model);
        out << "\n### " << model.name << ": " << model.beams << " beams, "
            << drive.scans.front().size() << " returns a scan\n\n"
            << onTheFlySection(report, drive, name);
    }
}

std::vector<std::pair<std::string, Scene>> withScans(
    std::vector<std::pair<std::string, Scene>> scenes) {
    std::vector<std::pair<std::string, Scene>> found;
    for (auto& s : scenes) {
        if (s.second.scans.empty())
            std::printf("%s: not there, left out\n", s.second.name.c_str());
        else
            found.push_back(std::move(s));
    }
    return found;
}

/** One line for each scene; its entries follow each other. */
void writeLost(const std::vector<std::pair<std::string, std::string>>& lost, std::ostream& out) {
    for (std::size_t i = 0; i < lost.size(); i++) {
        const bool is_first = i == 0 || lost[i].first != lost[i - 1].first;
        const bool is_last = i + 1 == lost.size() || lost[i].first != lost[i + 1].first;
        out << (is_first ? "- " + lost[i].first + ": " : ", ") << lost[i].second
            << (is_last ? ".\n" : "");
    }
    if (lost.empty()) out << "Nowhere in these tables.\n";
}

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
    const char* data = std::getenv("AKIMAP_DATA");
    const std::vector<Place> places = placesWithTruth(request.seeds);
    const Scene first = places.front().take(1);
    auto held_out_scenes =
        withScans({{"corridor", pcdFolder("Corridor (real lidar)",
                                          std::string(data ? data : "") + "/corridor")},
                   {"la3dm_unstructured",
                    pcdFolder("LA3DM unstructured", la3dmFolder() + "/sim_unstructured")},
                   {places.front().file, first}});
    if (!request.own.inputs.empty())
        held_out_scenes.emplace_back("own", scansOf(request.own.inputs.front(), request.own));

    std::ostringstream body;
    accuracy(report, places, body);
    equalTime(report, first, places.front().file, body);
    heldOut(report, held_out_scenes, body);
    onTheFly(report, body);

    std::ostringstream head;
    head << "# Benchmark\n\nWritten by `" << request.command << "` at commit " << request.commit
         << ": " << describeMachine()
         << ". Do not edit: every figure but the paper's own is measured by that command. Best "
            "figures are bold.\n"
         << heading("Where AkiMap is not the best");
    writeLost(report.lost, head);

    writeWhole(request.output, head.str() + body.str());
    std::printf("[%5.0f s] %s and its pictures in %s are written\n", clock.Tac(),
                request.output.c_str(), request.pictures.c_str());
}

}  // namespace

int main(int argc, char** argv) try {
    CLI::App app(
        "Measures AkiMap beside other maps, and writes BENCHMARK.md and its pictures.\n"
        "Scenes: simulated ones; LA3DM's in $LA3DM_DIR and a corridor in "
        "$AKIMAP_DATA/corridor, if there.");
    Request request;
    app.add_option("-o,--output", request.output, "The report")->capture_default_str();
    app.add_option("--pictures", request.pictures, "Folder for them")->capture_default_str();
    app.add_option("--seeds", request.seeds, "Recordings, or runs of random methods, to average")
        ->capture_default_str()
        ->check(CLI::PositiveNumber);
    app.add_option("--scans", request.own.inputs,
                   "Also judge by held-out scans of these: .rawlog, .simplemap or .pcd files");
    app.add_option("--trajectory", request.own.trajectory,
                   "TUM file of the robot's poses, for those rawlogs");
    app.add_option("--commit", request.commit, "Named in the report")->capture_default_str();
    CLI11_PARSE(app, argc, argv);
    run(request);
    return 0;
} catch (const std::exception& e) {
    std::fprintf(stderr, "benchmark_report: %s\n", e.what());
    return 1;
}
