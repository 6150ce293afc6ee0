// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <filesystem>
#include <functional>
#include <iostream>
#include <memory>
#include <stdexcept>

#include "cli.h"
#include "commands/commands.h"
#include "help.h"
#include "input/scan_feed.h"
#include "output/outputs.h"
#include "output/scan_log.h"

namespace akimap::app {

namespace {

constexpr const char* kFooter =
    "Scans without a time get one, a second apart; points that are not finite are left out.";

struct ConvertRequest {
    InputRequest input;
    std::string output;
    bool quiet = false;
};

void check(const ConvertRequest& request) {
    checkInputOptions(request.input);
    const std::string kind = std::filesystem::path(request.output).extension().string();
    if (kind != ".rawlog" && kind != ".simplemap")
        throw std::runtime_error(request.output + ": convert writes .rawlog and .simplemap");
    checkOutputs({request.output}, filesRead(request.input));
}

void run(const ConvertRequest& request) {
    check(request);
    ScanFeed feed(request.input);
    uint64_t scans = 0;
    writeScanLog(request.output, [&](const std::function<void(const Scan&)>& take) {
        feed.forEachScan(
            [&](const Scan& scan, uint64_t) {
                take(scan);
                scans++;
            },
            !request.quiet);
        if (scans == 0) throw std::runtime_error("nothing usable in the inputs");
    });
    if (feed.isFixed()) warn("all scans have one and the same pose; --poses FILE tells others");
    if (!request.quiet) std::cout << scans << " scans with poses in " << request.output << "\n";
}

}  // namespace

void addConvert(CLI::App& app) {
    auto* command = app.add_subcommand(
        "convert", "Write any input, with its poses, as a rawlog or simplemap for MRPT");
    command->footer(kFooter);
    const auto request = std::make_shared<ConvertRequest>();
    addInputOptions(*command, request->input);
    command->add_option("-o,--output", request->output, "The .rawlog or .simplemap to write")
        ->required();
    command->add_flag("--quiet", request->quiet, "No progress bar and no summary");
    addExamples(*command, "convert scans/ --poses poses.txt -o drive.rawlog",
                "convert drive.bag -o drive.simplemap");
    command->callback([request] { run(*request); });
}

}  // namespace akimap::app
