// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "scenes.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "input/PcdReader.h"

namespace akimap::bench {

Scene Scene::within(double max_range) const {
    Scene s = *this;
    for (auto& scan : s.scans) {
        const auto far = [&](const Ray& r) {
            return std::hypot(r.end[0] - r.origin[0], r.end[1] - r.origin[1],
                              r.end[2] - r.origin[2]) > max_range;
        };
        scan.erase(std::remove_if(scan.begin(), scan.end(), far), scan.end());
    }
    return s;
}

Scene simulated(app::SceneKind kind, uint64_t seed, double resolution) {
    app::SimulationOptions options;
    options.scene = kind, options.seed = seed;
    const auto drive = app::simulate(options);
    const auto box = app::scoringBox();
    return {kind == app::SceneKind::structured ? "structured" : "unstructured",
            app::simulatedRays(options),
            app::truthOf(*drive.truth(resolution)),
            {{box.min.x, box.min.y, box.min.z}, {box.max.x, box.max.y, box.max.z}}};
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
    feed.forEachScan([&](app::Scan& scan, uint64_t) { s.scans.push_back(app::raysOf(scan)); },
                     false);
    return s;
}

LidarDrive simulatedLidar(std::size_t scans, const LidarModel& model) {
    constexpr double kPi = 3.14159265358979323846, kMaxRange = 60, kNoise = 0.01;
    const app::Scene scene = app::makeScene(app::SceneKind::structured, 1);
    const app::Trajectory trajectory = app::makeDrive(scene, false, 1).trajectory;
    const app::World world{scene, trajectory, false, kNoise, kMaxRange};
    app::Random random(1, 4);
    LidarDrive drive{model.name, {}, 10};
    const double start = trajectory.keyframes().front().time,
                 span = trajectory.keyframes().back().time - start;
    for (std::size_t n = 0; n < scans; n++) {
        const double t = std::fmod(static_cast<double>(n) / drive.rate, span);
        const mrpt::poses::CPose3D sensor =
            trajectory.at(start + t) + mrpt::poses::CPose3D(0, 0, 1, 0, 0, 0);
        const mrpt::math::TPoint3D origin(sensor.x(), sensor.y(), sensor.z());
        auto& rays = drive.scans.emplace_back();
        for (std::size_t i = 0; i < model.beams * model.directions; i++) {
            const auto beam = static_cast<double>(i % model.beams),
                       turn = static_cast<double>(i / model.beams);
            const double elevation =
                (2 * model.height * beam / static_cast<double>(model.beams - 1) - model.height) *
                kPi / 180;
            const double azimuth = 2 * kPi * turn / static_cast<double>(model.directions);
            const auto direction =
                sensor.rotateVector({std::cos(elevation) * std::cos(azimuth),
                                     std::cos(elevation) * std::sin(azimuth), std::sin(elevation)});
            const auto range = app::measureRange(world, origin, direction, 0.3, random);
            if (!range) continue;
            const auto end = origin + direction * *range;
            rays.push_back({{origin.x, origin.y, origin.z}, {end.x, end.y, end.z}});
        }
    }
    return drive;
}

}  // namespace akimap::bench
