// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "estimators/hits.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>

namespace akimap {
namespace {

using Point = std::array<double, 3>;

bool isFinite(const Point& p) {
    return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
}
bool isUsable(const Ray& r, double length, const ScanParameters& p, const BlockGrid& grid,
              InsertionStats& stats) {
    if (!isFinite(r.origin) || !isFinite(r.end)) return ++stats.dropped_nonfinite, false;
    if (length == 0) return ++stats.dropped_zero, false;
    if (!p.takesLength(length) || (!r.hit && p.beyond_max_range == BeyondMaxRange::ignore))
        return ++stats.dropped_range, false;
    if (!grid.covers(r.origin[0], r.origin[1], r.origin[2]) ||
        !grid.covers(r.end[0], r.end[1], r.end[2]))
        return ++stats.dropped_grid, false;
    return true;
}

/** Of a beam that met nothing up to max_range or to its own end: that part; empty if it did, or is
 * of no use. */
std::optional<Ray> freePart(const Ray& r, const ScanParameters& p) {
    if (p.beyond_max_range != BeyondMaxRange::free || !isFinite(r.origin) || !isFinite(r.end))
        return std::nullopt;
    const double length = lengthOf(r);
    if (p.takesLength(length)) return r.hit ? std::nullopt : std::optional(r);
    if (length < p.max_range) return std::nullopt;
    return Ray{r.origin, placeAlong(r, p.max_range / length), false};
}

/** Keys relative to the anchor have room for 2^20 cells on each axis. */
bool isNear(const CellIndex& anchor, const Ray& r, const BlockGrid& grid) {
    const auto near = [&](const Point& p) {
        const CellIndex c = grid.cellAt(p[0], p[1], p[2]);
        return std::max({std::abs(c.x - anchor.x), std::abs(c.y - anchor.y),
                         std::abs(c.z - anchor.z)}) < (1 << 19);
    };
    return near(r.origin) && near(r.end);
}

}  // namespace

KeptRays takeHits(const std::vector<Ray>& rays, const ScanParameters& p, const BlockGrid& grid,
                  KeyTable& taken, Samples& samples, InsertionStats& stats) {
    samples.clear();
    taken.clear();
    KeptRays kept;
    KeyTable free_ends;
    std::optional<Sampler> sampler, free_sampler;
    uint64_t number = 0;
    for (const Ray& r : rays) {
        const std::optional<Ray> free = freePart(r, p);
        const double length = lengthOf(free ? *free : r);
        if (!isUsable(free ? *free : r, length, p, grid, stats)) continue;
        if (!sampler) {  // the first usable ray places the local frame
            const CellIndex b =
                BlockGrid::blockOf(grid.cellAt(r.origin[0], r.origin[1], r.origin[2]));
            samples.anchor = {b.x * Block::kSide, b.y * Block::kSide, b.z * Block::kSide};
            sampler.emplace(grid, taken, samples);
            free_sampler.emplace(grid, free_ends, samples);
        }
        if (!isNear(samples.anchor, free ? *free : r, grid)) {
            ++stats.dropped_grid;
            continue;
        }
        if (free) {
            ++stats.free_beams;
            if (free_sampler->take(free->end) == Sampler::kNew) kept.free.push_back(*free);
            continue;
        }
        const uint32_t by = sampler->addOrFind(r.end, length);
        if (by == Sampler::kNew)
            kept.hits.push_back({&r, number});
        else
            kept.hits[by].returns++;
        ++number;
    }
    stats.points += number;
    samples.occupied = samples.size();
    stats.rays += rays.size();
    stats.samples_occupied += samples.occupied;
    return kept;
}

}  // namespace akimap
