// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <iostream>
#include <memory>

#include "commands.h"
#include "evaluation/evaluate.h"
#include "output/AtomicFile.h"
#include "output/stream.h"

namespace akimap::app {

namespace {

struct EvalRequest {
    std::string map, truth, box, json;
};

void run(const EvalRequest& request) {
    const Box box = request.box.empty() ? Box{} : parseBox(request.box);
    if (!request.json.empty()) {
        if (request.json == request.map || request.json == request.truth)
            throw std::runtime_error(request.json + ": this output is an input too");
        AtomicFile::checkWritable(request.json);
    }
    const Truth truth = readTruth(request.truth);
    const auto map = AkiMap::loadFromFile(request.map);
    Evaluation evaluation;
    try {
        evaluation = evaluate(*map, truth, box);
    } catch (const std::exception& e) {
        throw std::runtime_error(request.truth + ": " + e.what());
    }
    if (!request.json.empty()) {
        AtomicFile file(request.json);
        std::ofstream out = openForWriting(file.path());
        out << toJson(evaluation).dump(2) << "\n";
        closeWritten(out);
        file.commit();
    }
    printTable(evaluation, std::cout);
}

}  // namespace

void addEval(CLI::App& app) {
    auto* command = app.add_subcommand("eval", "Compare a map with a known truth");
    command->footer(
        "known: the cells of the truth that the map has evidence for; all: every cell of the\n"
        "truth, with an occupancy of 0.5 where the map has none. Precision, recall and F1 are of\n"
        "cells called occupied above 0.5, free otherwise.");
    const auto request = std::make_shared<EvalRequest>();
    command->add_option("MAP", request->map, "The map (.akimap)")->required();
    command
        ->add_option("--truth", request->truth, "OctoMap binary tree (.bt) of the map's resolution")
        ->required();
    command
        ->add_option("--box", request->box,
                     "[m] Score only the cells whose centre lies in this box [default: all]")
        ->type_name("x0,y0,z0,x1,y1,z1");
    command->add_option("--json", request->json, "Write the figures to this file too");
    command->callback([request] { run(*request); });
}

}  // namespace akimap::app
