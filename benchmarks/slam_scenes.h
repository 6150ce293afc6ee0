// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <akimap/AkiMap.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/poses/CPose2D.h>

#include <memory>
#include <string>
#include <vector>

#include "simulation/simulate.h"

namespace akimap::bench {

/** A level laser scan of 360 beams in the simulated room. */
struct FlatScan {
    mrpt::obs::CObservation2DRangeScan::Ptr observation;
    mrpt::poses::CPose2D robot;  ///< in the map
};
/** From each place of the structured drive of that seed. */
[[nodiscard]] std::vector<FlatScan> flatScans(uint64_t seed);

struct IcpQuery {
    mrpt::maps::CSimplePointsMap cloud;  ///< in the robot's frame
    mrpt::poses::CPose3D truth, guess;
};
/** The same scans in both maps, and scans of another drive through the room to align to them. */
struct IcpCase {
    std::string name;
    bool flat;  ///< 2D
    mrpt::maps::CSimplePointsMap points;
    AkiMap aki;
    std::vector<IcpQuery> queries;
};
[[nodiscard]] std::vector<std::unique_ptr<IcpCase>> icpCases();

}  // namespace akimap::bench
