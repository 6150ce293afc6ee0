// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <akimap/AkiMap.h>

#include <string>
#include <vector>

#include "evaluation/octomap_scan.h"
#include "evaluation/truth.h"
#include "input/scan_feed.h"
#include "simulation/simulate.h"

namespace akimap::bench {

inline constexpr double kMaxRange = 8;  // [m]

/** One recording: scans in the map frame, and what is true of the place they were taken in. */
struct Scene {
    std::string name;
    std::vector<std::vector<Ray>> scans;
    app::Truth truth;              ///< no leaves if it is not known
    app::Box box;                  ///< the cells to score
    double max_range = kMaxRange;  ///< [m] returns farther away are left out, for all maps

    /** Without the returns farther than this [m]. */
    [[nodiscard]] Scene within(double limit) const;
};

/** A simulated drive with a depth camera, and its exact truth. Each seed is a recording of its own:
 * noise, places and, in the unstructured room, the things in it. */
[[nodiscard]] Scene simulated(app::SceneKind kind, uint64_t seed, double resolution);

/** The same for a lidar of 16 beams, 2 degrees apart, 900 directions each, noise of 2 cm, that sees
 * the whole of an unstructured room. No room is one of simulated()'s first ten. */
[[nodiscard]] Scene simulatedRings(uint64_t seed, double resolution);

/** LA3DM's folder: $LA3DM_DIR, by default $AKIMAP_DATA/la3dm. */
[[nodiscard]] std::string la3dmFolder();

/** LA3DM's structured scene with the truth of benchmarks/data; no scans if it is not there. */
[[nodiscard]] Scene la3dmStructured();

/** All .pcd files of a folder, in the order of the numbers in their names, without a truth; no
 * scans if it is not there. */
[[nodiscard]] Scene pcdFolder(const std::string& name, const std::string& folder);

/** The scans of any inputs that `akimap build` takes, without a truth. */
[[nodiscard]] Scene scansOf(const std::string& name, const app::InputRequest& inputs);

/** A drive with a spinning lidar at a steady rate. */
struct LidarDrive {
    std::string name;
    std::vector<std::vector<Ray>> scans;
    double rate;  ///< [Hz]
};

/** A spinning lidar: beams evenly apart between level +- height, in so many directions each. */
struct LidarModel {
    std::string name;
    std::size_t beams, directions;
    double height;  ///< [degrees]
};
[[nodiscard]] inline LidarModel sixteenBeams() {
    return {"simulated lidar", 16, 1875, 15};
}
/** Some 73,000 returns a scan. */
[[nodiscard]] inline LidarModel denseLidar() {
    return {"simulated dense lidar", 64, 1250, 22.5};
}

/** Through the simulated structured room at 10 Hz. */
[[nodiscard]] LidarDrive simulatedLidar(std::size_t scans,
                                        const LidarModel& model = sixteenBeams());

using app::asPointCloud;
using app::PointCloudScan;

}  // namespace akimap::bench
