// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <memory>

#include "commands/commands.h"
#include "help.h"
#include "mapping/build_map.h"

namespace akimap::app {

namespace {

constexpr const char* kOutputGroup = "Output";
constexpr const char* kFooter =
    "Where the sensor stood decides what is free: what lies between it and a return. Of a cloud\n"
    "--poses tells it, or the VIEWPOINT of a .pcd, whose points are then taken to be in the map\n"
    "frame. A VIEWPOINT with a rotation, none at all, and one besides --poses are refused: "
    "--frame\n"
    "sensor lets pose or VIEWPOINT place the points, --frame map takes them as they are.\n"
    "Poses in a file are told apart by their lines: 8 numbers are TUM's (time x y z qx qy qz qw),\n"
    "12 KITTI's, 16 or rows of 4 matrices, VERTEX_... g2o's. Those with times belong to files "
    "whose\n"
    "names are times, or by --times; others are taken in natural order, one a file.";

void addRealtimeOptions(CLI::App& command, BuildRequest& request, CLI::Option* follow) {
    auto* realtime = command.add_flag(
        "--realtime", request.realtime,
        "Map as on a robot: each update starts at its scan's time stamp and takes as long as it "
        "takes here; scans stamped before its end are lost, as are scans out of order");
    realtime->excludes(follow)->group(kInputGroup);
    command
        .add_option("--rate", request.rate,
                    "[Hz] > 0. With --realtime, scans come at this rate whatever their stamps; "
                    "needed for .pcd files, which have none [default: the stamps]")
        ->check(CLI::PositiveNumber)
        ->default_str("")
        ->needs(realtime)
        ->group(kInputGroup);
}

void addOutputOptions(CLI::App& command, BuildRequest& request) {
    command.add_option("-o,--output", request.output, "The map to write (.akimap)")
        ->required()
        ->group(kOutputGroup);
    command
        .add_option("--export", request.exports,
                    "Write the map as .csv, .ply, .pcd, .bt, .ot, .3Dscene or .png too; repeatable")
        ->allow_extra_args(false)
        ->default_str("")
        ->group(kOutputGroup);
    command.add_option("--json", request.json, "Write counts, times [s] and memory [bytes]")
        ->group(kOutputGroup);
    command
        .add_option("--on-interrupt", request.on_interrupt,
                    "^C or SIGTERM: save the map of the scans so far, or discard it; a second one "
                    "stops at once")
        ->check(CLI::IsMember({"save", "discard"}))
        ->type_name("NAME")
        ->group(kOutputGroup);
    command.add_flag("--quiet", request.quiet, "No progress bar and no table")->group(kOutputGroup);
}

}  // namespace

void addBuild(CLI::App& app) {
    auto* command = app.add_subcommand("build", "Build a map from logs and point clouds");
    const auto request = std::make_shared<BuildRequest>();
    addInputOptions(*command, request->input);
    auto* follow = addFollowOptions(*command, request->input);
    addRealtimeOptions(*command, *request, follow);
    addMapOptions(*command, request->map);
    addOutputOptions(*command, *request);
    command->footer(kFooter);
    addExamples(*command, "build drive.rawlog --poses poses.tum -o drive.akimap --export drive.png",
                "build scans/ --poses poses.txt --max-range 30 --resolution 0.1 -o s.akimap");
    command->callback([request] { buildMap(*request); });
}

}  // namespace akimap::app
