// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "scenes.h"

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

Scene la3dmStructured() {
    Scene s{"LA3DM structured", {}, {}, {{0, 0, 0}, {7.25, 10.2, 2.1}}};
    const char* data = std::getenv("AKIMAP_DATA");
    const std::string folder = std::string(data ? data : "") + "/la3dm/sim_structured/";
    if (!data || !std::filesystem::exists(folder + "truth_5cm.bt")) return s;
    for (int i = 1; i <= 12; i++)
        s.scans.push_back(app::readPcd(folder + "sim_structured_" + std::to_string(i) + ".pcd"));
    s.truth = app::readTruth(folder + "truth_5cm.bt");
    return s;
}

}  // namespace akimap::bench
