// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <akimap/AkiMap.h>

#include <vector>

namespace akimap {

/** The occupancy samples of one scan (paper, Sec. IV-B), in a frame whose axes are the map's and
 * whose origin is a cell corner near the sensor, so that floats are exact enough anywhere. */
struct Samples {
    CellIndex anchor;             ///< the local frame's origin is this cell's lowest corner
    std::vector<float> x, y, z;   ///< [m] local frame
    std::vector<float> distance;  ///< [m] from the sample's own ray origin
    std::size_t occupied = 0;     ///< the first so many are occupied (y = 1), the rest free (y = 0)

    [[nodiscard]] std::size_t size() const { return x.size(); }
    void clear();
};

/** A ray whose hit became a sample, and its number among the usable ones. */
struct KeptRay {
    const Ray* ray;
    uint64_t number;
};
struct KeptRays {
    std::vector<KeptRay> hits;
    std::vector<Ray> free;  ///< those that met nothing, cut off at max_range, at most one a cell
};

/** The first half of takeSamples(): only the hits, at most one a cell.
 * \return the ray of each */
KeptRays takeHits(const std::vector<Ray>& rays, const InsertionParameters& parameters,
                  const BlockGrid& grid, KeyTable& taken, Samples& samples, InsertionStats& stats);

/** Room 2: rays -> samples. One occupied sample per hit cell, one free sample at a random place
 * in every sampling distance along each ray whose hit was taken, and one at its origin; at most
 * one sample a cell, a hit before a miss, the earlier before the later. Rays that met nothing come
 * last.
 * \param taken scratch
 * \param scan_index with the seed it determines the random places
 * \param stats its drop and sample counters are increased */
void takeSamples(const std::vector<Ray>& rays, const InsertionParameters& parameters,
                 const BlockGrid& grid, uint64_t scan_index, KeyTable& taken, Samples& samples,
                 InsertionStats& stats);

}  // namespace akimap
