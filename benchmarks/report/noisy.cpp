// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "report/noisy.h"

#include <mrpt/system/CTicTac.h>

#include <cmath>

#include "evaluation/contest/entrants.h"
#include "evaluation/holdout.h"
#include "report/figures.h"
#include "report/markdown.h"
#include "report/predictions.h"

namespace akimap::bench {
namespace {

AkiMap configuredFor(const Scene& scene) {
    AkiMap map(scene.truth.resolution);
    map.insertionOptions.max_range = scene.max_range;
    map.insertionOptions.threads = 1;
    return map;
}

struct Judged {
    app::Evaluation evaluation;
    double seconds;
};

Judged judge(const app::Entrant& entrant, const Scene& scene) {
    const auto map = entrant.make();
    const InsertionParameters ranges = configuredFor(scene).insertionOptions;
    double seconds = 0;
    for (const auto& scan : scene.scans) {
        const std::vector<Ray> returns = app::raysInRange(scan, ranges);
        mrpt::system::CTicTac clock;
        map->insert({scan, returns});
        seconds += clock.Tac();
    }
    const app::OccupancyCells cells = map->cells();
    app::OccupancyCells::Reader reader(cells);
    const auto lookup = [&](double x, double y, double z) -> std::optional<double> {
        const float p = reader[cells.cellAt({x, y, z})];
        if (!app::isKnown(p)) return std::nullopt;
        return static_cast<double>(p);
    };
    return {app::evaluate(lookup, scene.truth.resolution, scene.truth, scene.box), seconds};
}

Row rowOf(const std::string& name, const app::Entrant& entrant, const std::vector<Scene>& scenes) {
    std::vector<app::Evaluation> runs;
    double seconds = 0;
    std::size_t scans = 0;
    for (const Scene& scene : scenes) {
        const Judged judged = judge(entrant, scene);
        runs.push_back(judged.evaluation);
        seconds += judged.seconds, scans += scene.scans.size();
    }
    Row row = summarize(name, accuracyColumns(), runs);
    row.more = {fixed(1e3 * seconds / static_cast<double>(scans), 1)};
    return row;
}

}  // namespace

std::vector<NoisySensor> noisySensors() {
    return {{"Kinect", app::SensorKind::kinect, 4},
            {"RealSense D435", app::SensorKind::realsense, 4},
            {"VLP-16", app::SensorKind::vlp16, 13},
            {"OS1-128", app::SensorKind::os1_128, 13}};
}

Scene noisyScene(const NoisySensor& sensor, uint64_t seed, double resolution) {
    constexpr double kPosition = 0.01, kAngle = 0.3 * M_PI / 180;  // [m], [rad]
    app::SimulationOptions options;
    options.scene = app::SceneKind::furnished, options.sensor = sensor.kind, options.seed = seed;
    options.max_range = sensor.max_range;
    options.pose_errors.position = kPosition, options.pose_errors.angle = kAngle;
    const app::SimulatedDrive drive = app::simulate(options);
    Scene scene{sensor.name, {}, app::truthOf(*drive.truth(resolution)), {}, sensor.max_range};
    for (const app::SimulatedScan& scan : drive.scans) scene.scans.push_back(scan.rays);
    return scene;
}

std::string noisySection(Report& report, const std::vector<Scene>& recordings) {
    const Scene& first = recordings.front();
    std::vector<Row> rows;
    for (const app::Entrant& entrant : app::standardEntrants(configuredFor(first))) {
        if (entrant.sees_held_out) continue;  // here all scans are inserted
        report.doing(first.name + ": " + entrant.name);
        rows.push_back(rowOf(entrant.name, entrant, recordings));
    }
    Trial trial;
    trial.name = first.name;
    trial.resolution = first.truth.resolution, trial.max_range = first.max_range;
    return "Against the truth, all scans inserted:\n\n" +
           tableOf(rows, accuracyColumns(), {"ms a scan"}, first.name + ", truth", report.lost) +
           "\nAnd as the real recordings are judged, the first recording: " +
           predictionTables(report, first.name, hold(trial, first.scans, report.doing));
}

}  // namespace akimap::bench
