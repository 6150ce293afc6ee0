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

/** The finalizer of SplitMix64: one well-mixed step. */
uint64_t mix(uint64_t v) {
    v += 0x9e3779b97f4a7c15u;
    v = (v ^ (v >> 30)) * 0xbf58476d1ce4e5b9u;
    v = (v ^ (v >> 27)) * 0x94d049bb133111ebu;
    return v ^ (v >> 31);
}
/** Uniform in [0, 1), a function of its place alone: no state to copy or to share. */
double uniform(uint64_t ray_key, uint64_t stretch) {
    return static_cast<double>(mix(ray_key + stretch) >> 11) * 0x1p-53;
}

double lengthOf(const Ray& r) {
    return std::hypot(r.end[0] - r.origin[0], r.end[1] - r.origin[1], r.end[2] - r.origin[2]);
}
bool isFinite(const Point& p) {
    return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
}
Point along(const Ray& r, double fraction) {
    Point p;
    for (std::size_t i = 0; i < 3; i++) p[i] = r.origin[i] + fraction * (r.end[i] - r.origin[i]);
    return p;
}

bool isUsable(const Ray& r, double length, const InsertionParameters& p, const BlockGrid& grid,
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
std::optional<Ray> freePart(const Ray& r, const InsertionParameters& p) {
    if (p.beyond_max_range != BeyondMaxRange::free || !isFinite(r.origin) || !isFinite(r.end))
        return std::nullopt;
    const double length = lengthOf(r);
    if (p.takesLength(length)) return r.hit ? std::nullopt : std::optional(r);
    if (length < p.max_range) return std::nullopt;
    return Ray{r.origin, along(r, p.max_range / length), false};
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

/** Appends samples, at most one a cell. */
class Sampler {
 public:
    Sampler(const BlockGrid& grid, KeyTable& taken, Samples& samples)
        : grid_(grid), taken_(taken), samples_(samples) {
        const CellIndex& a = samples.anchor;
        corner_ = {a.x * grid.resolution(), a.y * grid.resolution(), a.z * grid.resolution()};
    }
    bool add(const Point& p, double distance) {
        if (!take(p)) return false;
        samples_.x.push_back(static_cast<float>(p[0] - corner_[0]));
        samples_.y.push_back(static_cast<float>(p[1] - corner_[1]));
        samples_.z.push_back(static_cast<float>(p[2] - corner_[2]));
        samples_.distance.push_back(static_cast<float>(distance));
        return true;
    }
    /** Takes the point's cell; false if it was taken. */
    bool take(const Point& p) {
        return taken_.insert(keyInScan(grid_.cellAt(p[0], p[1], p[2])), 0).second;
    }

 private:
    /** Unique within 2^20 cells of the anchor on each axis. */
    [[nodiscard]] uint64_t keyInScan(const CellIndex& c) const {
        const CellIndex& a = samples_.anchor;
        return packKey({c.x - a.x, c.y - a.y, c.z - a.z});
    }

    const BlockGrid& grid_;
    KeyTable& taken_;
    Samples& samples_;
    Point corner_{};
};

void addFreeAlong(const KeptRay& kept, uint64_t scan_key, double stretch, Sampler& sampler) {
    const double length = lengthOf(*kept.ray);
    const uint64_t ray_key = mix(scan_key + kept.number);
    sampler.add(kept.ray->origin, 0);
    for (uint64_t k = 0; static_cast<double>(k) * stretch < length; k++) {
        const double t = (static_cast<double>(k) + uniform(ray_key, k)) * stretch;
        if (t < length) sampler.add(along(*kept.ray, t / length), t);
    }
}

}  // namespace

void Samples::clear() {
    for (auto* v : {&x, &y, &z, &distance}) v->clear();
    occupied = 0;
}

KeptRays takeHits(const std::vector<Ray>& rays, const InsertionParameters& p, const BlockGrid& grid,
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
            if (free_sampler->take(free->end)) kept.free.push_back(*free);
            continue;
        }
        if (sampler->add(r.end, length)) kept.hits.push_back({&r, number});
        ++number;
    }
    stats.points += number;
    samples.occupied = samples.size();
    stats.rays += rays.size();
    stats.samples_occupied += samples.occupied;
    return kept;
}

void takeSamples(const std::vector<Ray>& rays, const InsertionParameters& parameters,
                 const BlockGrid& grid, uint64_t scan_index, KeyTable& taken, Samples& samples,
                 InsertionStats& stats) {
    const auto kept = takeHits(rays, parameters, grid, taken, samples, stats);

    Sampler sampler(grid, taken, samples);
    const uint64_t scan_key = mix(mix(parameters.seed) + scan_index);
    for (const KeptRay& k : kept.hits)
        addFreeAlong(k, scan_key, parameters.sampling_distance, sampler);
    uint64_t number = rays.size();
    for (const Ray& r : kept.free)
        addFreeAlong({&r, number++}, scan_key, parameters.sampling_distance, sampler);

    stats.samples_free += samples.size() - samples.occupied;
}

}  // namespace akimap
