// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
// The real recordings, and what is known of each.
#include "recordings.h"
#include "report/predictions.h"
#include "scenes.h"

namespace akimap::bench {
namespace {

using Scans = std::vector<std::vector<Ray>>;

Trial office(const std::string& cells, double resolution) {
    Trial t{"RGB-D office, " + cells, "", "", resolution, 4, true, false, {}};
    t.scans = [] { return bench::raysOf(depthFrames(dataFolder("rgbd_office"))); };
    t.what = "rgbd_office, returns within 4 m. ";
    t.what += resolution < 0.05
                  ? "It was looked at while the default estimator was made."
                  : "Constants of the default estimator were chosen on its first fold.";
    return t;
}

Trial lidar(const std::string& cells, double resolution, double range) {
    Trial t{"Dense lidar, " + cells, "", "", resolution, range, true, false, {}};
    t.scans = [] { return bench::raysOf(posedClouds(dataFolder("lidar_dense"))); };
    t.what = resolution < 0.1
                 ? "lidar_dense. Constants of the default estimator were chosen on its first fold."
                 : "lidar_dense. With these cells and this range no constant was chosen.";
    return t;
}

Trial la3dm(const std::string& name, const std::string& folder, const std::string& what) {
    Trial t{name, "", what, 0.05, kMaxRange, true, false, {}};
    t.scans = [=] { return raised(pcdFolder("", la3dmFolder() + folder).scans, kLa3dmTooLow); };
    return t;
}

}  // namespace

std::vector<Trial> realTrials() {
    std::vector<Trial> trials;
    trials.push_back(office("2 cm cells", 0.02));
    trials.back().all_folds = false;  // a fold takes a minute
    trials.push_back(office("5 cm cells", 0.05));
    trials.back().file = "office", trials.back().has_picture = true;
    trials.push_back(office("10 cm cells", 0.10));
    trials.push_back(lidar("5 cm cells, 10 m", 0.05, 10));
    trials.back().file = "lidar", trials.back().has_picture = true;
    trials.push_back(lidar("10 cm cells, 30 m", 0.10, 30));
    trials.push_back(
        {"Corridor, 5 cm cells", "",
         "A sparse lidar, within 8 m. It was looked at while the default estimator was "
         "made; no constant was fitted to it.",
         0.05, kMaxRange, true, false, [] { return pcdFolder("", dataFolder("corridor")).scans; }});
    trials.push_back(la3dm("LA3DM long-term, sensor raised", "/sim_structured_long_term",
                           "A simulated sensor that others published, the same places visited "
                           "again and again; 5 cm cells, 8 m. It was looked at while the default "
                           "estimator was made."));
    trials.push_back(la3dm("LA3DM structured, sensor raised", "/sim_structured",
                           "The paper's scene with its sensor where it stood; 5 cm cells, 8 m. "
                           "No constant was chosen on it."));
    return trials;
}

}  // namespace akimap::bench
