// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include "cli.h"
#include "commands/commands.h"
#include "simulation/files.h"
#include "simulation/simulate.h"
#include "simulation/truth.h"

namespace akimap::app {

namespace {

const std::map<std::string, SceneKind> kScenes{{"structured", SceneKind::structured},
                                               {"unstructured", SceneKind::unstructured}};
const std::map<std::string, SensorKind> kSensors{{"depth", SensorKind::depth},
                                                 {"velodyne", SensorKind::velodyne},
                                                 {"pointcloud", SensorKind::pointcloud}};

struct SimulateRequest {
    std::string scene, folder;
    std::string sensor = "depth";
    double truth_resolution = 0.05;
    bool with_poses = false;
    SimulationOptions options;
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
    printFile(files.rawlog, scans + " (" + request.sensor + "), " + std::to_string(fewest) +
                                " to " + std::to_string(most) + " points each" +
                                (request.with_poses ? ", robot poses" : ""));
    printFile(files.trajectory,
              std::to_string(drive.trajectory.keyframes().size()) + " poses of the robot");
    printFile(files.simplemap, scans + " with poses");
    printFile(files.truth, std::to_string(truth.occupied) + " occupied and " +
                               std::to_string(truth.free) + " free cells");
    const auto box = scoringBox();
    std::printf("room: --box %g,%g,%g,%g,%g,%g\n", box.min.x, box.min.y, box.min.z, box.max.x,
                box.max.y, box.max.z);
}

void run(SimulateRequest& request) {
    request.options.scene = kScenes.at(request.scene);
    request.options.sensor = kSensors.at(request.sensor);
    if (request.options.moving && request.options.sensor != SensorKind::velodyne)
        throw std::runtime_error("--moving needs --sensor velodyne: '" + request.sensor +
                                 "' sees all of a scan at once");
    const SimulatedDrive drive = simulate(request.options);
    const DriveFiles files = prepareFolder(request.folder);  // before the truth takes seconds
    const auto truth = drive.truth(request.truth_resolution);
    writeDrive(drive, *truth, files, request.with_poses);
    printTable(request, drive, files, countCells(*truth));
}

}  // namespace

void addSimulate(CLI::App& app) {
    auto* command =
        app.add_subcommand("simulate", "Make a demo drive through a room, with its exact truth");
    command->footer(
        "Writes into DIR, replacing files of these names: scene.rawlog (the observations),\n"
        "trajectory.tum (the robot in the map), scene.simplemap (both, for observations2map) and\n"
        "truth.bt (OctoMap: visible surfaces occupied, what sight lines cross free).\n"
        "The room is 10 x 7 x 2 m; 12 scans of about 3500 points from four places, 8 m range.");
    const auto request = std::make_shared<SimulateRequest>();
    command
        ->add_option("SCENE", request->scene,
                     "structured: walls, boxes, pillars; unstructured: random pillars, spheres, "
                     "slabs")
        ->required()
        ->check(CLI::IsMember(namesOf(kScenes)));
    command->add_option("-o,--output", request->folder, "Folder to write into, made if missing")
        ->required()
        ->type_name("DIR");
    command->add_option("--seed", request->options.seed, "Seed of noise, poses and random things")
        ->check(kWholeNumber);
    command->add_option("--sensor", request->sensor, "Kind of observations")
        ->check(CLI::IsMember(namesOf(kSensors)));
    command->add_option("--noise", request->options.range_noise,
                        "[m] Standard deviation of the range noise");
    command->add_option("--truth-resolution", request->truth_resolution,
                        "[m] Side of a cell of truth.bt");
    command->add_flag("--moving", request->options.moving,
                      "Drive 0.4 m during each scan (velodyne only)");
    command->add_flag("--with-poses", request->with_poses,
                      "Add robot poses (CObservationRobotPose) to the rawlog");
    command->callback([request] { run(*request); });
}

}  // namespace akimap::app
