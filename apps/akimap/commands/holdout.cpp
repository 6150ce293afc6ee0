// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <filesystem>
#include <iostream>
#include <memory>

#include "cli.h"
#include "commands/commands.h"
#include "evaluation/contest/contest.h"
#include "evaluation/contest/contest_report.h"
#include "evaluation/contest/depth_picture.h"
#include "evaluation/report.h"
#include "help.h"
#include "input/scan_feed.h"
#include "mapping/map_options.h"
#include "output/outputs.h"
#include "support/AtomicFile.h"

namespace akimap::app {

namespace {

constexpr const char* kOutputGroup = "Output";
constexpr const char* kFooter =
    "Does a map predict what the next scan sees? Some scans are held out; the maps are built from\n"
    "the others and judged by those held out:\n"
    "  AkiMap     as configured\n"
    "  paper      --estimator paper: the paper's method\n"
    "  isotropic  --bandwidth isotropic: kernels of one size\n"
    "  OctoMap    its library's insertPointCloud(), discretized\n"
    "  TSDF       a plain truncated signed distance field: the strongest predictor, no evidence\n"
    "  OctoMap+   OctoMap that got the held-out scans too: what is possible\n"
    "\n"
    "Rays. Each held-out return within the range limits (at most 20000 of a scan, evenly) is cast\n"
    "from its origin through the map to four cells behind it; the first cell with an occupancy\n"
    "above 0.5 stops it. Shares of all rays cast:\n"
    "  near1, near3  stopped within 1.5, 3.5 cells of the return: the wall is where it was seen\n"
    "  early         stopped before that: the map blocks what is open\n"
    "  phantom       the early ones by a cell with no held-out return within one cell of it:\n"
    "                a door made narrower or a wall that is none, not merely a surface grazed\n"
    "  late          stopped behind that\n"
    "  miss          not stopped: the map has open what is blocked\n"
    "  unknown       the missed ones where the map has no evidence at the return\n"
    "  depth error   of the rays stopped: median and 90th percentile\n"
    "Differences from OctoMap are taken scan by scan: their mean, the lowest and the highest.\n"
    "\n"
    "Faithfulness. Of the cells with three or more returns of the scans that the map got, the\n"
    "share that is occupied, and that has an occupied cell within one cell.\n"
    "\n"
    "Queries. Each return's place is occupied; along its ray one place every 0.5 m is free, up to\n"
    "0.2 m before it, or up to 1.5 cells before it and there too. AUC: how well the occupancy\n"
    "tells them apart, 1 at best; Brier score: its mean squared error; log-loss: mean of\n"
    "-ln(p of what is true), p kept within 0.01 and 0.99; calibration error: how far occupancies\n"
    "are from the frequencies they stand for; F1: of cells called occupied above 0.5. Over the\n"
    "queries that all maps have evidence for, over those that each has, and over all, with an\n"
    "occupancy of 0.5 where it has none.";

struct HoldoutRequest {
    InputRequest input;
    MapRequest map;
    std::size_t every = 5, depth_scan = 0;
    std::string folds = "one", json, roc, calibration, depth_picture;
    bool quiet = false;
};

ContestRules rulesOf(const HoldoutRequest& request, const AkiMap& configured) {
    ContestRules rules = rulesFor(configured);
    rules.every = request.every;
    rules.all_folds = request.folds == "all";
    if (request.depth_scan > 0) rules.view = request.depth_scan - 1;
    return rules;
}

void check(const HoldoutRequest& request) {
    checkInputOptions(request.input);
    if (request.every < 2)
        throw std::runtime_error("--every must be at least 2: the map needs scans too");
    const bool is_held_out = request.folds == "all" || request.depth_scan % request.every == 0;
    if (!is_held_out)
        throw std::runtime_error("--depth-scan " + std::to_string(request.depth_scan) +
                                 ": with --every " + std::to_string(request.every) +
                                 " this scan is not held out");
    if (request.quiet && request.json.empty() && request.roc.empty() &&
        request.calibration.empty() && request.depth_picture.empty())
        throw std::runtime_error(
            "--quiet without an output leaves nothing to do: --json, --roc, "
            "--calibration or --depth-picture FILE");
    std::vector<std::string> read = filesRead(request.input);
    read.push_back(request.map.config);
    checkOutputs({request.json, request.roc, request.calibration, request.depth_picture}, read);
    for (const std::string& plot : {request.roc, request.calibration})
        if (!plot.empty()) checkPlottable(plot);
    const std::string& picture = request.depth_picture;
    if (!picture.empty() && std::filesystem::path(picture).extension() != ".png")
        throw std::runtime_error(picture + ": the depth picture is a .png");
}

void plotCurves(const ContestResult& result, const HoldoutRequest& request) {
    if (request.roc.empty() && request.calibration.empty()) return;
    std::vector<Judgement> maps;
    for (std::size_t i = 0; i < result.maps.size(); i++)
        maps.push_back(judge(result.maps[i].name, scoredCells(result.answers, i)));
    if (!request.roc.empty()) writeFigure(rocFigure(maps), request.roc);
    if (!request.calibration.empty()) writeFigure(calibrationFigure(maps), request.calibration);
}

void hold(const HoldoutRequest& request) {
    const AkiMap configured = makeMapFor(request.map);
    check(request);
    ScanFeed feed(request.input);
    const bool with_free = configured.insertionOptions.beyond_max_range == BeyondMaxRange::free;
    const Recording recording = [&](const auto& take) {
        feed.forEachScan([&](const Scan& scan, uint64_t) { take(raysOf(scan, with_free)); },
                         !request.quiet);
    };
    const ContestResult result =
        holdContest(recording, standardEntrants(configured), rulesOf(request, configured));
    if (!request.json.empty()) writeWhole(request.json, toJson(result).dump(2) + "\n");
    if (!request.quiet) printTable(result, std::cout);
    plotCurves(result, request);
    if (!request.depth_picture.empty()) writeDepthPicture(result, request.depth_picture);
}

void run(const HoldoutRequest& request) {
    std::vector<std::string> others = filesRead(request.input);
    others.insert(others.end(),
                  {request.map.config, request.roc, request.calibration, request.depth_picture});
    withErrorsInJson(request.json, others, [&] { hold(request); });
}

void addOutputOptions(CLI::App& command, HoldoutRequest& request) {
    const auto add = [&](const char* flag, auto& value, const char* help) {
        return command.add_option(flag, value, help)->group(kOutputGroup);
    };
    auto* picture = add("--depth-picture", request.depth_picture,
                        "Draw a held-out scan (.png): its depth, the depth by each map, and where "
                        "they differ: early red, missed blue");
    add("--depth-scan", request.depth_scan,
        "Its number, counted from 1; 0: the one in the middle of those held out")
        ->check(kWholeNumber)
        ->needs(picture)
        ->type_name("N");
    add("--roc", request.roc, "Draw the ROC curves (.png or .svg)");
    add("--calibration", request.calibration, "Draw the reliability diagram (.png or .svg)");
    add("--json", request.json, "Write the figures to this file too");
    command.add_flag("--quiet", request.quiet, "No progress bar and no table")->group(kOutputGroup);
}

}  // namespace

void addHoldout(CLI::App& app) {
    auto* command = app.add_subcommand(
        "holdout", "Judge maps without a truth: by scans that are held out from them");
    command->footer(kFooter);
    const auto request = std::make_shared<HoldoutRequest>();
    addInputOptions(*command, request->input);
    command
        ->add_option("--every", request->every,
                     ">= 2. Hold out scans N, 2 N, ... of all inputs together")
        ->check(kWholeNumber)
        ->type_name("N")
        ->group(kInputGroup);
    command
        ->add_option("--folds", request->folds,
                     "all: hold out each scan once, one in N at a time; one: scans N, 2 N, ...")
        ->check(CLI::IsMember({"one", "all"}))
        ->group(kInputGroup);
    addMapOptions(*command, request->map);
    addOutputOptions(*command, *request);
    addExamples(*command, "holdout drive.rawlog --poses poses.tum --every 5",
                "holdout scans/ --poses poses.txt --depth-picture next.png --json next.json");
    command->callback([request] { run(*request); });
}

}  // namespace akimap::app
