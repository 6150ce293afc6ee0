// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <cmath>
#include <iostream>
#include <memory>

#include "commands/commands.h"
#include "help.h"
#include "input/ProgressBar.h"
#include "output/export_map.h"

namespace akimap::app {

namespace {

struct ExportRequest {
    std::string map, output;
    double slice = 0;
    ExportOptions options;
};

void run(const ExportRequest& request) {
    if (!(request.options.threshold > 0 && request.options.threshold < 1))
        throw std::runtime_error("--threshold must be above 0 and below 1");
    if (request.options.slice && !std::isfinite(*request.options.slice))
        throw std::runtime_error("--slice must be a finite height [m]");
    checkExportable(request.output);
    if (request.options.unknown && !drawsUnknown(request.output))
        std::cerr << "akimap: --unknown changes nothing in '" << request.output
                  << "': only .png and .3Dscene draw cells without evidence\n";
    const StageLine stage("exporting " + request.output);
    exportMap(*AkiMap::loadFromFile(request.map), request.output, request.options);
}

}  // namespace

void addExport(CLI::App& app) {
    auto* command = app.add_subcommand("export", "Write a map in another format");
    const auto request = std::make_shared<ExportRequest>();
    command->add_option("MAP", request->map, "The map (.akimap)")->required();
    command
        ->add_option("OUT", request->output,
                     "The file to write: .csv, .ply, .pcd, .bt, .ot, .3Dscene or .png")
        ->required();
    command->add_option("--threshold", request->options.threshold,
                        "[-] in (0,1). Cells of a higher occupancy are occupied");
    command->add_flag("--unknown", request->options.unknown,
                      "Draw where free space ends in cells without evidence (.png, .3Dscene)");
    command->add_option(
        "--slice", request->options.slice,
        "[m] Height of the slice in a .png [default: above the floor, where most is known]");
    addExamples(*command, "export drive.akimap drive.ply",
                "export drive.akimap drive.png --slice 1.2 --unknown");
    command->callback([request] { run(*request); });
}

}  // namespace akimap::app
