// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "recordings.h"

namespace akimap::bench {

/** Where is a sensor whose scan the maps never got? */
struct LocalizationCase {
    std::string name;
    std::vector<PosedScan> scans;
    double resolution, max_range;  ///< [m]
};

struct LocalizationRules {
    std::size_t every = 5;       ///< scans every, 2 every, ... are looked for, the others mapped
    std::size_t starts = 30;     ///< in all, as many for each scan looked for
    double offset = 0.15;        ///< [m] a start is so far off at most, along each axis
    double angle = 0.09;         ///< [rad] and about each
    std::size_t returns = 1000;  ///< of the scan looked for, at most, evenly
    uint64_t seed = 1;
};

/** How far from the recorded poses one map's estimates lie, by one method. */
struct PoseEstimates {
    std::string method, map;
    std::vector<double> metres, radians, seconds;  ///< by start; none: the map has no such method

    /** Share of the estimates within 5 cm and 2 degrees; NaN without estimates. */
    [[nodiscard]] double good() const;
};

/** ICP (mrpt::slam::CICP, by the map's determineMatching3D()), and the maximum of the map's
 * observation likelihood near the start, for a CSimplePointsMap, a COctoMap and an AkiMap of the
 * same returns. A COctoMap matches no points. The same for any number of threads, but for times.
 * \param doing gets what comes next
 * \exception std::runtime_error if there are fewer scans than `every` */
[[nodiscard]] std::vector<PoseEstimates> localize(
    const LocalizationCase& recording, const LocalizationRules& rules,
    const std::function<void(const std::string&)>& doing);

/** The real ones of $AKIMAP_DATA, those that are there. */
[[nodiscard]] std::vector<LocalizationCase> localizationCases();

}  // namespace akimap::bench
