// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <array>
#include <string>
#include <vector>

#include "methods.h"

namespace akimap::bench {

using CellPlace = std::array<int, 3>;  ///< holds [i, i + 1) times the resolution along each axis

/** A scan, and where someone was when it was taken. */
struct WatchedScan {
    std::vector<Ray> rays;
    std::vector<CellPlace> someone;  ///< sorted: cells cut by them, and by nothing that stays
};

struct WatchedWalk {
    std::string name;
    double resolution, max_range;  ///< [m]
    std::vector<WatchedScan> scans;
    std::size_t gone;  ///< the first scan after someone has left
};

/** Someone crosses the structured room before a robot that stands there, 5 scans a second, stops
 * halfway for three seconds, and is then gone for ten. \param sensor  with its own errors */
[[nodiscard]] WatchedWalk simulatedWalk(app::SensorKind sensor, const std::string& name,
                                        uint64_t seed, double resolution);

/** What a map does with places that were left. Occupied: p > 0.5. */
struct Residue {
    /** After each scan: occupied cells in which someone was before and is no more. */
    std::vector<std::size_t> cells;
    /** After each scan: occupied cells in which someone is. A map that never sees them has no
     * residue either. */
    std::vector<std::size_t> present;
    /** For each cell that was occupied when someone left it: the scans from then on until it was
     * not, that one included. A cell that is entered again meanwhile is not counted. */
    std::vector<std::size_t> waits;
    std::size_t never = 0;  ///< such cells that were occupied to the end
};

/** Inserts scan by scan and looks after each. */
[[nodiscard]] Residue watch(MapUnderTest& map, const WatchedWalk& walk);

}  // namespace akimap::bench
