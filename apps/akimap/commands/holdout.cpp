// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "evaluation/holdout.h"

#include <mrpt/core/format.h>

#include <algorithm>
#include <iostream>
#include <memory>

#include "cli.h"
#include "commands/commands.h"
#include "evaluation/octomap_scan.h"
#include "evaluation/report.h"
#include "input/scan_feed.h"
#include "mapping/map_options.h"
#include "output/AtomicFile.h"

namespace akimap::app {

namespace {

constexpr const char* kOutputGroup = "Output";

struct HoldoutRequest {
    InputRequest input;
    MapRequest map;
    uint64_t every = 5;
    std::string json, roc, calibration;
    bool quiet = false;
};

/** The maps that get the same scans, and the rays that none of them gets. */
struct Contest {
    explicit Contest(const MapRequest& request)
        : akimap(makeMapFor(request)), isotropic(akimap), octomap(akimap.resolution()) {
        isotropic.insertionOptions.estimator = Estimator::paper;
        isotropic.insertionOptions.bandwidth = Bandwidth::isotropic;
    }
    AkiMap akimap, isotropic;
    mrpt::maps::COctoMap octomap;
    std::vector<Ray> held_out;
    uint64_t scans = 0, held_out_scans = 0;
};

/** How the maps fared, and their figures as JSON. */
struct Results {
    std::vector<Judgement> maps;
    std::vector<nlohmann::ordered_json> figures;
};

void takeScan(Contest& contest, const Scan& scan, bool held_out) {
    contest.scans++;
    const std::vector<Ray> usable = raysInRange(raysOf(scan), contest.akimap.insertionOptions);
    if (held_out) {
        contest.held_out_scans++;
        contest.held_out.insert(contest.held_out.end(), usable.begin(), usable.end());
        return;
    }
    insertScan(contest.akimap, scan);
    insertScan(contest.isotropic, scan);
    insertRays(contest.octomap, usable);
}

Results results(const Contest& contest) {
    Results all;
    const auto add = [&](const char* name, const auto& map) {
        all.maps.push_back(judge(name, collect(lookupIn(map), contest.held_out)));
        all.figures.push_back(toJson(all.maps.back().evaluation));
    };
    add("AkiMap", contest.akimap);
    add("isotropic", contest.isotropic);
    add("COctoMap", contest.octomap);
    return all;
}

std::string textOf(const nlohmann::ordered_json& figure) {
    if (figure.is_null()) return "-";
    return figure.is_number_float() ? mrpt::format("%.4f", figure.get<double>()) : figure.dump();
}

/** Rows: the figures whose JSON names begin with `set`, "known" or "all"; columns: the maps. */
void printTable(const std::string& set, const Results& results, std::ostream& out) {
    const auto row = [&](std::string name, const auto& textOfMap) {
        std::replace(name.begin(), name.end(), '_', ' ');
        out << mrpt::format("%-20s", name.c_str());
        for (std::size_t i = 0; i < results.maps.size(); i++)
            out << mrpt::format("%12s", textOfMap(i).c_str());
        out << "\n";
    };
    row(set + " queries", [&](std::size_t i) { return results.maps[i].name; });
    for (const auto& figure : results.figures.front().items()) {
        const std::string& key = figure.key();
        if (key.rfind(set + "_", 0) != 0) continue;
        const std::string name = key.substr(set.size() + 1);
        row(name == "cells" ? "queries" : name,
            [&](std::size_t i) { return textOf(results.figures[i][key]); });
    }
}

void writeJson(const Contest& contest, const Results& results, const std::string& file) {
    nlohmann::ordered_json json{{"scans", contest.scans},
                                {"scans_held_out", contest.held_out_scans},
                                {"queries", results.figures.front()["all_cells"]}};
    for (std::size_t i = 0; i < results.maps.size(); i++)
        json[results.maps[i].name] = results.figures[i];
    writeWhole(file, json.dump(2) + "\n");
}

void run(const HoldoutRequest& request) {
    Contest contest(request.map);
    checkInputOptions(request.input);
    if (request.every < 2)
        throw std::runtime_error("--every must be at least 2: the map needs scans too");
    std::vector<std::string> read = request.input.inputs;
    read.insert(read.end(), {request.map.config, request.input.trajectory});
    checkOutputs({request.json, request.roc, request.calibration}, read);
    for (const std::string& plot : {request.roc, request.calibration})
        if (!plot.empty()) checkPlottable(plot);

    ScanFeed feed(request.input);
    const auto take = [&](const Scan& scan, uint64_t number) {
        takeScan(contest, scan, isHeldOut(number, request.every));
    };
    feed.forEachScan(take, !request.quiet);
    if (contest.scans < request.every)
        throw std::runtime_error(std::to_string(contest.scans) + " scans in the inputs: with " +
                                 "--every " + std::to_string(request.every) + " none is held out");
    if (contest.akimap.isEmpty())
        throw std::runtime_error("nothing usable in the scans that are not held out");
    const Results all = results(contest);
    if (!request.roc.empty()) writeFigure(rocFigure(all.maps), request.roc);
    if (!request.calibration.empty()) writeFigure(calibrationFigure(all.maps), request.calibration);
    if (!request.json.empty()) writeJson(contest, all, request.json);
    if (request.quiet) return;
    std::cout << contest.scans << " scans, " << contest.held_out_scans << " of them held out\n\n";
    printTable("known", all, std::cout);
    std::cout << "\n";
    printTable("all", all, std::cout);
}

}  // namespace

void addHoldout(CLI::App& app) {
    auto* command = app.add_subcommand(
        "holdout", "Judge maps without a truth: by scans that are held out from them");
    command->footer(
        "The map is built from the other scans. Each held-out ray within the range limits then\n"
        "asks for its end, which is occupied, and for one place every 0.5 m up to 0.2 m before\n"
        "it, which are free. known: where the map has evidence, each map by its own; all: with\n"
        "an occupancy of 0.5 elsewhere. Beside it stand the same map with --estimator paper\n"
        "--bandwidth isotropic and MRPT's COctoMap (its defaults, the same cells and points), "
        "from\n"
        "the same scans. Beams without a return are no queries, and nothing to COctoMap.\n"
        "mse is the Brier score.");
    const auto request = std::make_shared<HoldoutRequest>();
    addInputOptions(*command, request->input);
    command
        ->add_option("--every", request->every,
                     ">= 2. Hold out scans N, 2 N, ... of all inputs together")
        ->check(kWholeNumber)
        ->type_name("N")
        ->group(kInputGroup);
    addMapOptions(*command, request->map);
    command->add_option("--roc", request->roc, "Draw the ROC curves (.png or .svg)")
        ->group(kOutputGroup);
    command
        ->add_option("--calibration", request->calibration,
                     "Draw the reliability diagram (.png or .svg)")
        ->group(kOutputGroup);
    command->add_option("--json", request->json, "Write the figures to this file too")
        ->group(kOutputGroup);
    command->add_flag("--quiet", request->quiet, "No progress bar and no table")
        ->group(kOutputGroup);
    command->callback([request] { run(*request); });
}

}  // namespace akimap::app
