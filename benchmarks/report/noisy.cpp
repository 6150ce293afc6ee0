// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "report/noisy.h"

#include <mrpt/system/CTicTac.h>

#include <cmath>

#include "evaluation/contest/entrants.h"
#include "evaluation/holdout.h"
#include "report/closeup.h"
#include "report/figures.h"
#include "report/markdown.h"
#include "report/predictions.h"
#include "simulation/Scene.h"

namespace akimap::bench {
namespace {

AkiMap configuredFor(const Scene& scene) {
    AkiMap map(scene.truth.resolution);
    map.insertionOptions.max_range = scene.max_range;
    map.insertionOptions.threads = 1;
    return map;
}

/** A map of all scans, which must stay where it is while its lookup is used. */
struct MappedScene {
    app::OccupancyCells cells;
    double seconds;  ///< of insertion

    [[nodiscard]] app::OccupancyLookup lookup() const {
        return [&map = cells, reader = app::OccupancyCells::Reader(cells)](
                   double x, double y, double z) mutable -> std::optional<double> {
            const float p = reader[map.cellAt({x, y, z})];
            if (!app::isKnown(p)) return std::nullopt;
            return static_cast<double>(p);
        };
    }
};

MappedScene mapped(const app::Entrant& entrant, const Scene& scene) {
    const auto map = entrant.make();
    const InsertionParameters ranges = configuredFor(scene).insertionOptions;
    double seconds = 0;
    for (const auto& scan : scene.scans) {
        const std::vector<Ray> returns = app::raysInRange(scan, ranges);
        mrpt::system::CTicTac clock;
        map->insert({scan, returns});
        seconds += clock.Tac();
    }
    return {map->cells(), seconds};
}

Row rowOf(const std::string& name, const app::Entrant& entrant, const std::vector<Scene>& scenes) {
    std::vector<app::Evaluation> runs;
    double seconds = 0;
    std::size_t scans = 0;
    for (const Scene& scene : scenes) {
        const MappedScene map = mapped(entrant, scene);
        runs.push_back(app::evaluate(map.lookup(), scene.truth.resolution, scene.truth, scene.box));
        seconds += map.seconds, scans += scene.scans.size();
    }
    Row row = summarize(name, accuracyColumns(), runs);
    row.more = {fixed(1e3 * seconds / static_cast<double>(scans), 1)};
    return row;
}

/** What is hard in the furnished room. */
std::vector<Patch> hardPlaces() {
    const double floor = app::Scene::floorHeight();
    const auto box = [&](double x0, double y0, double z0, double x1, double y1, double z1) {
        return app::Box{{x0, y0, floor + z0}, {x1, y1, floor + z1}};
    };
    return {{"The frame of a door of 0.9 m", box(4.8, 0.7, 0, 5.4, 2.2, 2), M_PI + 0.5, 0.3},
            {"A chair and a desk, legs of 3 cm", box(8.5, 2.2, 0, 10, 4.1, 1), M_PI + 0.6, 0.3},
            {"A floor, grazed", box(5.6, 3.2, -0.15, 7.4, 5, 0.4), M_PI + 0.7, 0.5},
            {"A wall, seen from afar", box(9.6, 4.4, 0.4, 10.25, 6.2, 1.9), M_PI + 0.4, 0.3}};
}

void drawHardPlaces(const Scene& scene, const std::string& file) {
    std::vector<MappedScene> kept;
    std::vector<std::string> names;
    for (const app::Entrant& e : app::standardEntrants(configuredFor(scene)))
        if (e.name == "OctoMap" || e.name == "paper" || e.name == "AkiMap")
            kept.push_back(mapped(e, scene)), names.push_back(e.name);
    std::vector<NamedMap> maps;
    for (std::size_t i = 0; i < kept.size(); i++) maps.push_back({names[i], kept[i].lookup()});
    writeCloseUps(scene, maps, hardPlaces(), file);
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
    const std::string picture =
        "/closeup_" + std::string(first.name, 0, first.name.find(' ')) + ".png";
    drawHardPlaces(first, report.pictures + picture);
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
           predictionTables(report, first.name, hold(trial, first.scans, report.doing)) + "\n" +
           image("A door's frame, legs of a chair and a desk, a grazed floor and a far wall",
                 report.pictures_link + picture);
}

}  // namespace akimap::bench
