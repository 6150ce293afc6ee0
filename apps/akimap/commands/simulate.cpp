// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <mrpt/core/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "cli.h"
#include "commands/commands.h"
#include "help.h"
#include "simulation/files.h"
#include "simulation/simulate.h"
#include "simulation/truth.h"

namespace akimap::app {

namespace {

const std::map<std::string, SceneKind> kScenes{{"structured", SceneKind::structured},
                                               {"unstructured", SceneKind::unstructured},
                                               {"furnished", SceneKind::furnished}};
const std::map<std::string, SensorKind> kSensors{
    {"depth", SensorKind::depth},           {"velodyne", SensorKind::velodyne},
    {"pointcloud", SensorKind::pointcloud}, {"kinect", SensorKind::kinect},
    {"realsense", SensorKind::realsense},   {"vlp16", SensorKind::vlp16},
    {"os1-128", SensorKind::os1_128},       {"os0-64", SensorKind::os0_64}};
constexpr double kDegree = M_PI / 180;

struct ErrorOption {
    const char* name;
    double RangeErrors::*value;
    const char* help;
};
constexpr ErrorOption kErrorOptions[] = {
    {"--noise", &RangeErrors::constant, "[m] Standard deviation of the range noise"},
    {"--noise-growth", &RangeErrors::linear, "[m/m] What it grows by for each metre of range"},
    {"--disparity-noise", &RangeErrors::disparity,
     "[1/m] Cameras: standard deviation of 1/depth; noise that grows with the square"},
    {"--disparity-step", &RangeErrors::disparity_step,
     "[1/m] Cameras: 1/depth is rounded to multiples of it"},
    {"--range-step", &RangeErrors::range_step, "[m] Lidars: ranges are rounded to multiples of it"},
    {"--beam-offset", &RangeErrors::beam_offset,
     "[m] Lidars: standard deviation of what each beam always measures too much"},
    {"--beam", &RangeErrors::beam, "[rad] Width of what a pixel or pulse sees: mixes edges"},
    {"--mixing", &RangeErrors::mixing,
     "[m] Edges up to so deep give a range between the two surfaces', deeper ones one of both"},
    {"--grazing", &RangeErrors::grazing,
     "Cosine of the angle of incidence below which more and more returns are lost"},
    {"--dark-loss", &RangeErrors::dark_loss, "Share of the returns lost off dark things"},
    {"--glass-pass", &RangeErrors::glass_pass, "Share of the rays that see through glass"}};

struct SimulateRequest {
    std::string scene, folder;
    std::string sensor = "depth";
    double truth_resolution = 0.05;
    bool with_poses = false;
    SimulationOptions options;
    double pose_angle = 0, pose_drift_angle = 0;                   // [degrees]
    std::vector<std::pair<double RangeErrors::*, double>> errors;  // in place of the sensor's own
};

template <class Value>
std::vector<std::string> namesOf(const std::map<std::string, Value>& values) {
    std::vector<std::string> names;
    for (const auto& [name, value] : values) names.push_back(name);
    return names;
}

void printFile(const std::string& file, const std::string& contents) {
    const double kilobytes = 1e-3 * static_cast<double>(std::filesystem::file_size(file));
    std::printf("%-36s %8.0f kB   %s\n", file.c_str(), kilobytes, contents.c_str());
}

void printTable(const SimulateRequest& request, const SimulatedDrive& drive,
                const DriveFiles& files, const TruthCounts& truth) {
    std::size_t fewest = SIZE_MAX, most = 0;
    for (const SimulatedScan& scan : drive.scans) {
        fewest = std::min(fewest, scan.rays.size());
        most = std::max(most, scan.rays.size());
    }
    const std::string scans = std::to_string(drive.scans.size()) + " scans";
    const std::string poses = std::to_string(drive.trajectory.keyframes().size()) + " poses";
    printFile(files.rawlog, scans + " (" + request.sensor + "), " + std::to_string(fewest) +
                                " to " + std::to_string(most) + " points each" +
                                (request.with_poses ? ", robot poses" : ""));
    printFile(files.trajectory, poses + " of the robot");
    printFile(files.true_trajectory, poses + " without pose errors");
    printFile(files.simplemap, scans + " with poses");
    printFile(files.truth, std::to_string(truth.occupied) + " occupied and " +
                               std::to_string(truth.free) + " free cells");
    const auto box = scoringBox();
    std::printf("room: --box %g,%g,%g,%g,%g,%g\n", box.min.x, box.min.y, box.min.z, box.max.x,
                box.max.y, box.max.z);
}

/** What the request asks of the simulation. */
SimulationOptions optionsOf(const SimulateRequest& request) {
    SimulationOptions options = request.options;
    options.scene = kScenes.at(request.scene);
    options.sensor = kSensors.at(request.sensor);
    if (options.moving && sensorModel(options.sensor).pattern != Pattern::packets)
        throw std::runtime_error("--moving needs --sensor velodyne or vlp16: '" + request.sensor +
                                 "' sees all of a scan at once");
    options.errors = sensorModel(options.sensor).errors;
    for (const auto& [error, value] : request.errors) *options.errors.*error = value;
    options.pose_errors.angle = request.pose_angle * kDegree;
    options.pose_errors.drift_angle = request.pose_drift_angle * kDegree;
    return options;
}

void run(const SimulateRequest& request) {
    const SimulatedDrive drive = simulate(optionsOf(request));
    const DriveFiles files = prepareFolder(request.folder);  // before the truth takes seconds
    const auto truth = drive.truth(request.truth_resolution);
    writeDrive(drive, *truth, files, request.with_poses);
    printTable(request, drive, files, countCells(*truth));
}

/** The sensors' own values of the errors, for the help. */
std::string sensorTable() {
    std::string table = "Sensors, and their values of the options of range errors:\n";
    const auto columnOf = [](const std::string& name) {
        return std::max(9, static_cast<int>(name.size()) + 1);
    };
    table += mrpt::format("%-17s", "");
    for (const auto& [name, kind] : kSensors)
        table += mrpt::format("%*s", columnOf(name), name.c_str());
    const auto row = [&](const std::string& name, auto&& valueOf) {
        table += mrpt::format("\n%-17s", name.c_str());
        for (const auto& [sensor, kind] : kSensors)
            table += mrpt::format("%*.3g", columnOf(sensor), valueOf(sensorModel(kind)));
    };
    for (const ErrorOption& option : kErrorOptions)
        row(option.name, [&](const SensorModel& m) { return m.errors.*option.value; });
    row("--max-range", [](const SensorModel& m) { return m.max_range; });
    row("least range [m]", [](const SensorModel& m) { return m.min_range; });
    return table;
}

void addErrorOptions(CLI::App& command, const std::shared_ptr<SimulateRequest>& request) {
    constexpr const char* kRanges = "Errors of ranges (default: the sensor's own, below)";
    for (const ErrorOption& option : kErrorOptions)
        command
            .add_option_function<double>(
                option.name,
                [request, error = option.value](const double& value) {
                    request->errors.emplace_back(error, value);
                },
                option.help)
            ->group(kRanges);
    command
        .add_option_function<double>(
            "--max-range", [request](const double& value) { request->options.max_range = value; },
            "[m] Returns farther away are lost")
        ->group(kRanges);

    constexpr const char* kPoses = "Errors of the recorded poses";
    const auto add = [&](const char* name, double& value, const char* help) {
        command.add_option(name, value, help)->capture_default_str()->group(kPoses);
    };
    PoseErrors& errors = request->options.pose_errors;
    add("--pose-noise", errors.position, "[m] Standard deviation on each axis, anew for each scan");
    add("--pose-noise-angle", request->pose_angle, "[degrees] The same of yaw, pitch and roll");
    add("--pose-drift", errors.drift_position,
        "[m] Standard deviation on each axis of what each scan adds to the error");
    add("--pose-drift-angle", request->pose_drift_angle,
        "[degrees] The same of yaw, pitch and roll");
}

}  // namespace

void addSimulate(CLI::App& app) {
    auto* command =
        app.add_subcommand("simulate", "Make a demo drive through a room, with its exact truth");
    command->footer(
        "Writes into DIR, replacing files of these names: scene.rawlog (the observations),\n"
        "trajectory.tum (the robot in the map), true_trajectory.tum (without pose errors),\n"
        "scene.simplemap (observations and poses, for observations2map) and truth.bt (OctoMap:\n"
        "visible surfaces occupied, what sight lines cross free; glass is a surface).\n"
        "The room is 10 x 7 x 2 m; 12 scans from four places, of depth, velodyne and pointcloud\n"
        "about 3500 points each.\n\n" +
        sensorTable());
    const auto request = std::make_shared<SimulateRequest>();
    command
        ->add_option("SCENE", request->scene,
                     "structured: walls, boxes, pillars; unstructured: random pillars, spheres, "
                     "slabs; furnished: two rooms with doors, a window, legs of tables and "
                     "chairs, poles, stairs and a slope")
        ->required()
        ->check(CLI::IsMember(namesOf(kScenes)));
    command->add_option("-o,--output", request->folder, "Folder to write into, made if missing")
        ->required()
        ->type_name("DIR");
    command->add_option("--seed", request->options.seed, "Seed of errors, poses and random things")
        ->check(kWholeNumber);
    command->add_option("--sensor", request->sensor, "Kind of observations and of errors")
        ->check(CLI::IsMember(namesOf(kSensors)));
    command->add_option("--truth-resolution", request->truth_resolution,
                        "[m] Side of a cell of truth.bt");
    command->add_flag("--moving", request->options.moving,
                      "Drive 0.4 m during each scan (velodyne and vlp16 only)");
    command->add_flag("--with-poses", request->with_poses,
                      "Add robot poses (CObservationRobotPose) to the rawlog");
    addErrorOptions(*command, request);
    addExamples(*command, "simulate structured -o drive",
                "simulate furnished --sensor kinect --pose-noise 0.01 -o home");
    command->callback([request] { run(*request); });
}

}  // namespace akimap::app
