// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <akimap/AkiMap.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "evaluation/contest/OccupancyCells.h"

namespace akimap::app {

/** A scan as the maps of a contest get it. */
struct ContestScan {
    const std::vector<Ray>& all;      ///< as it came, for maps with range rules of their own
    const std::vector<Ray>& returns;  ///< finite returns within the range limits and the grid
};

/** A map that takes part. */
struct Contestant {
    virtual ~Contestant() = default;
    virtual void insert(const ContestScan& scan) = 0;
    /** What it says after the last scan. Called once. */
    [[nodiscard]] virtual OccupancyCells cells() = 0;
};

/** A kind of map that takes part: a new one is made for each fold. */
struct Entrant {
    std::string name;  ///< short: the head of a column
    std::string what;  ///< in a few words
    std::function<std::unique_ptr<Contestant>()> make;
    bool sees_held_out = false;  ///< gets the held-out scans too: a yardstick, no contestant
};

/** AkiMap as configured, with the paper's method, and with isotropic kernels; OctoMap; a plain
 * TSDF; and OctoMap that also got the held-out scans. All have the configured map's cells.
 * \param configured an empty map */
[[nodiscard]] std::vector<Entrant> standardEntrants(const AkiMap& configured);
/** What the others are compared with. */
inline constexpr const char* kReferenceEntrant = "OctoMap";

[[nodiscard]] Entrant akimapEntrant(const std::string& name, const std::string& what,
                                    const AkiMap& configured);
/** OctoMap's own library: insertPointCloud(), discretized, with no range limit of its own; it gets
 * the returns within the limits only. \param resolution [m] */
[[nodiscard]] Entrant octomapEntrant(double resolution);
[[nodiscard]] Entrant tsdfEntrant(double resolution);

}  // namespace akimap::app
