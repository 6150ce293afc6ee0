// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <akimap/Ray.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "evaluation/contest/OccupancyCells.h"

namespace akimap::app {

// Does a map predict what the next scan sees? Each return of a scan that the map never got is cast
// from its origin through the map, cell by cell, to four cells behind the return. The first cell
// with an occupancy above 0.5 stops it, midway between where the ray enters and leaves it.

/** Where a ray ends in a map. */
enum class RayEnd : uint8_t {
    near1,    ///< stopped within 1.5 cells of the return, before or behind it
    near3,    ///< farther from it, but within 3.5 cells
    grazed,   ///< stopped farther before it, within one cell of a surface that was seen
    phantom,  ///< stopped farther before it where nothing is: a door made narrower, a false wall
    late,     ///< stopped farther behind it
    missed,   ///< not stopped, though the map has evidence in the return's cell
    unknown   ///< not stopped, and the map has none there
};

struct RayOutcome {
    RayEnd end;
    float depth;  ///< [m] from the origin to where the ray is stopped; NaN if it is not
};

/** How many returns fell into each cell. */
using ReturnCounts = SparseCells<uint32_t>;
/** \pre the rays' ends lie in the grid (SparseCells::covers()) */
void countReturns(const std::vector<Ray>& rays, ReturnCounts& counts);

/** Casts a scan. The result does not depend on the number of threads.
 * \param returns of all held-out scans: a ray that is stopped early within one cell (26 neighbours)
 * of one of them has grazed a surface
 * \pre rays that have a length and lie in the grid */
[[nodiscard]] std::vector<RayOutcome> castRays(const OccupancyCells& map,
                                               const ReturnCounts& returns,
                                               const std::vector<Ray>& rays);

/** Shares of the rays cast, in [0, 1], and errors of depth of those that are stopped. All NaN
 * without rays; near1 + near3's rest + early + late + miss = 1. */
struct RayShares {
    double near1 = 0;    ///< stopped within 1.5 cells of the return
    double near3 = 0;    ///< within 3.5 cells, near1 included
    double early = 0;    ///< before that
    double phantom = 0;  ///< of all rays, those stopped early where nothing was seen
    double late = 0;     ///< behind that
    double miss = 0;     ///< not stopped
    double unknown = 0;  ///< of all rays, those missed for lack of evidence at the return
    double depth_error_median = 0;  ///< [m] of |depth - measured| of the rays stopped
    double depth_error_90 = 0;      ///< [m] its 90th percentile
};

/** Adds up the outcomes of scans. */
class RayTally {
 public:
    /** \pre one outcome for each ray */
    void add(const std::vector<Ray>& rays, const std::vector<RayOutcome>& outcomes);
    [[nodiscard]] std::size_t rays() const { return rays_; }
    [[nodiscard]] RayShares shares() const;

 private:
    std::size_t rays_ = 0;
    std::array<std::size_t, 7> counts_{};  // by RayEnd
    std::vector<float> errors_;            // [m]
};

/** A figure of RayShares: tables and JSON go by these. */
struct RayFigure {
    const char *key, *name;  ///< in JSON, in tables
    double RayShares::*value;
    bool is_length;  ///< [m], in tables [mm]; else a share
};
[[nodiscard]] const std::vector<RayFigure>& rayFigures();

}  // namespace akimap::app
