// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <mrpt/maps/CMetricMap.h>
#include <mrpt/math/TPoint3D.h>

#include <functional>
#include <string>
#include <vector>

namespace akimap::bench {

/** A class of 3D maps: a column of the table. */
struct MapKind {
    std::string name;                                   ///< without its namespace
    std::string ini;                                    ///< `<ini>_count` asks for one
    std::string max_range_key;                          ///< of its `_insertOpts`
    std::function<mrpt::maps::CMetricMap::Ptr()> make;  ///< cells of 0.1 m
    /** Of the cell around a point [m]; 0.5 where nothing is known. */
    std::function<double(const mrpt::maps::CMetricMap&, const mrpt::math::TPoint3D&)> occupancy;
    std::function<double(const mrpt::maps::CMetricMap&)> max_range;  ///< [m] as its options say
    std::function<void(mrpt::maps::CMetricMap&, double)> set_max_range;
};

/** AkiMap first, then what this MRPT has. */
[[nodiscard]] const std::vector<MapKind>& mapKinds();

}  // namespace akimap::bench
