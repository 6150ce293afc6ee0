// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "commands/commands.h"
#include "evaluation/octomap_file.h"
#include "evaluation/report.h"
#include "help.h"
#include "input/ProgressBar.h"
#include "output/outputs.h"
#include "support/AtomicFile.h"

namespace akimap::app {

namespace {

struct EvalRequest {
    std::string map, truth, box, json, roc, calibration;
    std::vector<std::string> compared;
};

/** Finds what is wrong with the outputs before the work starts. */
void checkRequest(const EvalRequest& request) {
    std::vector<std::string> read = request.compared;
    read.insert(read.end(), {request.map, request.truth});
    checkOutputs({request.json, request.roc, request.calibration}, read);
    if (!request.roc.empty()) checkPlottable(request.roc);
    if (!request.calibration.empty()) checkPlottable(request.calibration);
}

ScoredCells cellsOf(const std::string& file, const EvalRequest& request, const Truth& truth,
                    const Box& box) {
    const StageLine stage("evaluating " + file);
    const auto collected = [&](const auto& map, double resolution) {
        try {
            return collect(lookupIn(map), resolution, truth, box);
        } catch (const std::exception& e) {
            throw std::runtime_error(file + " against " + request.truth + ": " + e.what());
        }
    };
    if (isOctoMapFile(file)) {
        const auto tree = readOctoMap(file);
        return collected(*tree, tree->getResolution());
    }
    const auto map = AkiMap::loadFromFile(file);
    return collected(*map, map->resolution());
}

void writeJson(const std::vector<Judgement>& maps, const std::string& name) {
    // A file's name need not be UTF-8.
    writeWhole(name,
               toJson(maps).dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

void evaluate(const EvalRequest& request) {
    const Box box = request.box.empty() ? Box{} : parseBox(request.box);
    checkRequest(request);
    const Truth truth = readTruth(request.truth);
    std::vector<Judgement> maps = {judge(request.map, cellsOf(request.map, request, truth, box))};
    for (const std::string& file : request.compared)
        maps.push_back(judge(file, cellsOf(file, request, truth, box)));
    if (!request.roc.empty()) writeFigure(rocFigure(maps), request.roc);
    if (!request.calibration.empty()) writeFigure(calibrationFigure(maps), request.calibration);
    if (!request.json.empty()) writeJson(maps, request.json);
    printTable(maps, std::cout);
}

void run(const EvalRequest& request) {
    std::vector<std::string> others = request.compared;
    others.insert(others.end(), {request.map, request.truth, request.roc, request.calibration});
    withErrorsInJson(request.json, others, [&] { evaluate(request); });
}

constexpr const char* kFooter =
    R"(known     the cells of the truth that the map has evidence for
all       every cell of the truth; where the map has no evidence its occupancy is 0.5
coverage  known cells / all cells
auc       area under the ROC curve: how often an occupied cell gets a higher occupancy
          than a free one, ties counting 1/2; 1 is best, 0.5 is chance
mse       mean of (occupancy - truth)^2, the Brier score; 0 is best, always 0.5 gives 0.25
log loss  mean of -ln(probability given to what is true), probabilities clamped to
          [0.01, 0.99]; 0.01 is best, always 0.5 gives 0.69
calibration error
          expected calibration error: the mean of |mean occupancy - fraction truly occupied|
          over 10 equal bins of occupancy, each weighted by its cells; 0 is best
precision, recall, f1
          of cells called occupied above an occupancy of 0.5, free otherwise: the share of
          right ones among those called so; the share of those that are so that is found;
          their harmonic mean
-         undefined: nothing was called so, is so, or is known
ROC curve (--roc): true against false positive rate over all thresholds of occupancy.
Reliability diagram (--calibration): how often cells of an occupancy are truly occupied, in
10 bins, known cells only; on the diagonal the map's occupancy is the true frequency.
A .bt holds no probabilities, only occupied (read as 0.97) and free (0.12).)";

}  // namespace

void addEval(CLI::App& app) {
    auto* command = app.add_subcommand("eval", "Compare a map with a known truth");
    command->footer(kFooter);
    const auto request = std::make_shared<EvalRequest>();
    command->add_option("MAP", request->map, "The map (.akimap, or OctoMap's .bt or .ot)")
        ->required();
    command
        ->add_option("--truth", request->truth, "OctoMap binary tree (.bt) of the map's resolution")
        ->required();
    command
        ->add_option("--compare", request->compared,
                     "Judge this map too, and show how it differs from MAP; repeatable")
        ->type_name("MAP")
        ->allow_extra_args(false)
        ->default_str("");
    command
        ->add_option("--box", request->box,
                     "[m] Score only the cells whose centre lies in this box [default: all]")
        ->type_name("x0,y0,z0,x1,y1,z1");
    command->add_option("--roc", request->roc, "Draw the ROC curves (.png or .svg)");
    command->add_option("--calibration", request->calibration,
                        "Draw the reliability diagram (.png or .svg)");
    command->add_option("--json", request->json,
                        "Write all figures, the points of the ROC curves and the bins of the "
                        "reliability diagram to this file too");
    addExamples(*command, "eval drive.akimap --truth truth.bt",
                "eval drive.akimap --truth truth.bt --compare other.ot --roc roc.png");
    command->callback([request] { run(*request); });
}

}  // namespace akimap::app
