// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "scenes.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "input/clouds/PcdReader.h"
#include "simulation/truth.h"

namespace akimap::bench {
namespace {

constexpr double kDegree = M_PI / 180;
constexpr double kNearest = 0.3;  // [m]

mrpt::poses::CPose3D lidarAt(const app::World& world, double time) {
    return world.trajectory.at(time) + mrpt::poses::CPose3D(0, 0, 1, 0, 0, 0);
}

/** One turn of a lidar. */
std::vector<Ray> takeRings(const app::World& world, double time, const LidarModel& lidar,
                           app::Random& random) {
    const mrpt::poses::CPose3D sensor = lidarAt(world, time);
    const mrpt::math::TPoint3D origin = sensor.translation();
    std::vector<Ray> rays;
    for (std::size_t i = 0; i < lidar.beams * lidar.directions; i++) {
        const auto beam = static_cast<double>(i % lidar.beams),
                   turn = static_cast<double>(i / lidar.beams);
        const double elevation =
            kDegree * lidar.height * (2 * beam / static_cast<double>(lidar.beams - 1) - 1);
        const double azimuth = 2 * M_PI * turn / static_cast<double>(lidar.directions);
        const auto direction =
            sensor.rotateVector({std::cos(elevation) * std::cos(azimuth),
                                 std::cos(elevation) * std::sin(azimuth), std::sin(elevation)});
        const auto range = app::measureRange(world, origin, direction, kNearest, random);
        if (!range) continue;
        const auto end = origin + direction * *range;
        rays.push_back({{origin.x, origin.y, origin.z}, {end.x, end.y, end.z}});
    }
    return rays;
}

app::Box boxToScore() {
    const auto box = app::scoringBox();
    return {{box.min.x, box.min.y, box.min.z}, {box.max.x, box.max.y, box.max.z}};
}

}  // namespace

Scene Scene::within(double limit) const {
    Scene s = *this;
    for (auto& scan : s.scans) {
        const auto far = [&](const Ray& r) {
            return std::hypot(r.end[0] - r.origin[0], r.end[1] - r.origin[1],
                              r.end[2] - r.origin[2]) > limit;
        };
        scan.erase(std::remove_if(scan.begin(), scan.end(), far), scan.end());
    }
    return s;
}

Scene simulated(app::SceneKind kind, uint64_t seed, double resolution) {
    app::SimulationOptions options;
    options.scene = kind, options.seed = seed;
    const auto drive = app::simulate(options);
    return {kind == app::SceneKind::structured ? "structured" : "unstructured",
            app::simulatedRays(options), app::truthOf(*drive.truth(resolution)), boxToScore()};
}

Scene simulatedRings(uint64_t seed, double resolution) {
    constexpr double kRange = 13, kNoise = 0.02;  // [m] the room's diagonal is 12.4 m
    constexpr uint64_t kSeedsOfOthers = 10;
    seed += kSeedsOfOthers;
    const app::Scene room = app::makeScene(app::SceneKind::unstructured, seed);
    const app::Drive drive = app::makeDrive(room, false, seed);
    app::RangeErrors errors;
    errors.constant = kNoise;
    const app::World world{room, drive.trajectory, false, errors, kRange};
    app::Random random(seed, 4);
    const LidarModel lidar{"", 16, 900, 15};
    const double highest = kDegree * lidar.height;
    Scene scene{"unstructured, lidar", {}, {}, boxToScore(), kRange};
    std::vector<app::View> views;
    for (const double time : drive.scan_times) {
        scene.scans.push_back(takeRings(world, time, lidar, random));
        views.push_back({lidarAt(world, time), app::FieldOfView::band(0, M_PI, -highest, highest),
                         kNearest, kRange});
    }
    scene.truth = app::truthOf(*app::visibleTruth(room, views, resolution));
    return scene;
}

std::string la3dmFolder() {
    if (const char* folder = std::getenv("LA3DM_DIR"); folder && *folder) return folder;
    const char* data = std::getenv("AKIMAP_DATA");
    return std::string(data ? data : "") + "/la3dm";
}

Scene la3dmStructured() {
    Scene s = pcdFolder("LA3DM structured", la3dmFolder() + "/sim_structured");
    s.truth = app::readTruth(AKIMAP_BENCHMARK_DATA "/la3dm_structured_5cm.bt");
    s.box = {{0, 0, 0}, {7.25, 10.2, 2.1}};
    return s;
}

Scene pcdFolder(const std::string& name, const std::string& folder) {
    Scene s{name, {}, {}, {}};
    if (!std::filesystem::is_directory(folder)) return s;
    std::vector<std::pair<std::size_t, std::string>> files;  // shorter names have smaller numbers
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        if (entry.path().extension() == ".pcd")
            files.emplace_back(entry.path().string().size(), entry.path().string());
    std::sort(files.begin(), files.end());
    for (const auto& [length, file] : files) s.scans.push_back(app::readPcd(file));
    return s;
}

Scene scansOf(const std::string& name, const app::InputRequest& inputs) {
    Scene s{name, {}, {}, {}};
    app::ScanFeed feed(inputs);
    feed.forEachScan(
        [&](app::Scan& scan, uint64_t) { s.scans.push_back(app::raysOf(scan, false)); }, false);
    return s;
}

LidarDrive simulatedLidar(std::size_t scans, const LidarModel& model) {
    constexpr double kRange = 60, kNoise = 0.01;
    const app::Scene scene = app::makeScene(app::SceneKind::structured, 1);
    const app::Trajectory trajectory = app::makeDrive(scene, false, 1).trajectory;
    app::RangeErrors errors;
    errors.constant = kNoise;
    const app::World world{scene, trajectory, false, errors, kRange};
    app::Random random(1, 4);
    LidarDrive drive{model.name, {}, 10};
    const double start = trajectory.keyframes().front().time,
                 span = trajectory.keyframes().back().time - start;
    for (std::size_t n = 0; n < scans; n++) {
        const double t = std::fmod(static_cast<double>(n) / drive.rate, span);
        drive.scans.push_back(takeRings(world, start + t, model, random));
    }
    return drive;
}

}  // namespace akimap::bench
