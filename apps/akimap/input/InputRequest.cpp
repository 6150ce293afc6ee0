// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "input/InputRequest.h"

#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "cli.h"

namespace akimap::app {

namespace {

template <class Value>
CLI::Option* add(CLI::App& command, const char* flag, Value& value, const char* help) {
    return command.add_option(flag, value, help)->group(kInputGroup);
}

void addPoseOptions(CLI::App& command, InputRequest& request) {
    add(command, "--poses,--trajectory", request.poses,
        "Poses in the map: TUM, KITTI, 4x4, g2o or Open3D file, or a folder of one a scan "
        "[default: the logs' own, VIEWPOINT of .pcd]")
        ->type_name("FILE");
    add(command, "--times", request.times,
        "Times [s] of clouds or images, a line each, for poses by time")
        ->type_name("FILE");
    add(command, "--extrinsic", request.extrinsic,
        "Pose of the sensor of clouds or images on what the poses are of: x,y,z,yaw,pitch,roll "
        "[m, degrees], a 4x4, or a file (KITTI's calib.txt)")
        ->type_name("POSE");
    add(command, "--frame", request.frame,
        "What the points of clouds are in; map: VIEWPOINT or pose only say where the sensor "
        "stood; sensor: they place the points too")
        ->check(CLI::IsMember({"map", "sensor"}))
        ->type_name("NAME");
    command
        .add_flag("--no-deskew", request.no_deskew,
                  "Leave clouds whose points have times as they are")
        ->group(kInputGroup);
    add(command, "--max-gap", request.max_gap,
        "[s] > 0. Largest gap bridged between poses with times");
}

void addDepthOptions(CLI::App& command, DepthRequest& request) {
    auto* depth = add(command, "--depth", request.images,
                      "Depth images: a folder of .png of 16 bits, or TUM RGB-D's depth.txt");
    depth->type_name("DIR");
    add(command, "--intrinsics", request.intrinsics,
        "Their camera: fx,fy,cx,cy [pixels], or a file (3x3, Open3D's .json)")
        ->needs(depth)
        ->type_name("FILE");
    add(command, "--depth-scale", request.scale,
        "Their steps for a metre (1000: mm; TUM RGB-D: 5000), or, below 1, metres for a step")
        ->needs(depth);
}

}  // namespace

void addInputOptions(CLI::App& command, InputRequest& request) {
    command
        .add_option(
            "INPUT", request.inputs,
            "Logs (.rawlog, .simplemap, .bag), point clouds (.pcd .ply .bin .txt .csv "
            ".xyz), or folders of clouds; folders, and lists with --poses, in natural order")
        ->default_str("");
    addPoseOptions(command, request);
    addDepthOptions(command, request.depth);
    add(command, "--only", request.only_label, "Take only observations with this sensor label")
        ->type_name("LABEL");
    add(command, "--first", request.first, "Take only the first so many scans; 0: all")
        ->check(kWholeNumber);
    command
        .add_flag("--partial", request.partial,
                  "Of a rawlog cut in its last object, take what is whole")
        ->group(kInputGroup);
    command
        .add_flag("--allow-external", request.allow_external,
                  "Take clouds and depth images that a log keeps in other files from outside its "
                  "folder too")
        ->group(kInputGroup);
}

CLI::Option* addFollowOptions(CLI::App& command, InputRequest& request) {
    auto* follow = command.add_flag("--follow", request.follow,
                                    "The last INPUT is a rawlog that is still being written: map "
                                    "it as it grows, until --idle or ^C, then write the map");
    follow->group(kInputGroup);
    command
        .add_option("--idle", request.idle,
                    "[s] > 0. A followed rawlog ends when it has not grown so long")
        ->group(kInputGroup)
        ->needs(follow);
    return follow;
}

void checkInputOptions(const InputRequest& request) {
    const auto want = [](bool ok, const char* what) {
        if (!ok) throw std::runtime_error(what);
    };
    want(!request.inputs.empty() || !request.depth.images.empty(),
         "INPUT is required: logs, point clouds or a folder of them; or --depth DIR");
    want(std::isfinite(request.max_gap) && request.max_gap > 0, "--max-gap must be finite and > 0");
    want(std::isfinite(request.idle) && request.idle > 0, "--idle must be finite and > 0");
    want(std::isfinite(request.depth.scale) && request.depth.scale > 0,
         "--depth-scale must be finite and > 0");
    want(!request.follow || !request.inputs.empty(), "--follow needs an INPUT, a rawlog");
}

std::vector<std::string> filesRead(const InputRequest& request) {
    std::vector<std::string> files;
    const auto add = [&](const std::string& file) {
        files.push_back(file);
        std::error_code ignored;
        for (const auto& entry : std::filesystem::directory_iterator(file, ignored))
            files.push_back(entry.path().string());
    };
    for (const std::string& input : request.inputs) add(input);
    for (const std::string* file : {&request.poses, &request.times, &request.extrinsic,
                                    &request.depth.images, &request.depth.intrinsics})
        if (!file->empty()) add(*file);
    return files;
}

}  // namespace akimap::app
