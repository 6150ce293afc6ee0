// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <akimap/AkiMap.h>

#include <string>
#include <vector>

#include "evaluation/octomap_scan.h"
#include "evaluation/truth.h"
#include "simulation/simulate.h"

namespace akimap::bench {

/** Scans in the map frame and what is true of the place they were taken in. */
struct Scene {
    std::string name;
    std::vector<std::vector<Ray>> scans;
    app::Truth truth;  ///< no leaves if it is not known
    app::Box box;      ///< the cells to score

    /** Without the returns farther than max_range [m]. */
    [[nodiscard]] Scene within(double max_range) const;
};

/** A simulated drive with its exact truth. */
[[nodiscard]] Scene simulated(app::SceneKind kind, uint64_t seed, double resolution);

/** LA3DM's structured scene from $AKIMAP_DATA/la3dm; no scans if it is not there. */
[[nodiscard]] Scene la3dmStructured();

using app::asPointCloud;
using app::PointCloudScan;

}  // namespace akimap::bench
