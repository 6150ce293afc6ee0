// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "evaluation/holdout.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <sstream>
#include <stdexcept>

namespace akimap::app {

namespace {

constexpr double kSpacing = 0.5;    // [m] of the free places
constexpr double kClearance = 0.2;  // [m] between the last of them and the end
constexpr double kRounding = 1e-9;  // [m] poses are applied in floating point

std::size_t freeCount(double length) {
    const double room = length - kClearance + kRounding;
    return room < kSpacing ? 0 : static_cast<std::size_t>(room / kSpacing);
}

void checkCount(const std::vector<Ray>& held_out) {
    double queries = 0;
    for (const Ray& ray : held_out) queries += 1 + static_cast<double>(freeCount(lengthOf(ray)));
    if (queries == 0) throw std::runtime_error("the held-out scans have no point within range");
    if (queries <= kMaxScoredCells) return;
    std::ostringstream text;
    text << queries << " queries are more than " << kMaxScoredCells << ": hold out fewer scans";
    throw std::runtime_error(text.str());
}

}  // namespace

std::vector<Query> queriesOf(const Ray& ray) {
    std::vector<Query> queries;
    const double length = lengthOf(ray);
    for (std::size_t k = 1; k <= freeCount(length); k++) {
        const double fraction = kSpacing * static_cast<double>(k) / length;
        std::array<double, 3> place;
        for (std::size_t i = 0; i < 3; i++)
            place[i] = ray.origin[i] + fraction * (ray.end[i] - ray.origin[i]);
        queries.push_back({place, false});
    }
    queries.push_back({ray.end, true});
    return queries;
}

std::vector<Ray> raysInRange(const std::vector<Ray>& rays, const InsertionParameters& ranges) {
    std::vector<Ray> kept;
    std::copy_if(rays.begin(), rays.end(), std::back_inserter(kept),
                 [&](const Ray& ray) { return ranges.takesLength(lengthOf(ray)); });
    return kept;
}

ScoredCells collect(const OccupancyLookup& lookup, const std::vector<Ray>& held_out) {
    checkCount(held_out);
    ScoredCells cells;
    for (const Ray& ray : held_out)
        for (const Query& query : queriesOf(ray)) {
            const auto occupancy = lookup(query.place[0], query.place[1], query.place[2]);
            if (occupancy) cells.known.push_back({*occupancy, query.occupied});
            cells.all.push_back({occupancy.value_or(0.5), query.occupied});
        }
    return cells;
}

ScoredCells collect(const OccupancyLookup& lookup, const std::vector<std::vector<Ray>>& scans,
                    const std::vector<std::size_t>& held_out, const InsertionParameters& ranges) {
    std::vector<Ray> rays;
    for (const std::size_t i : held_out) {
        const std::vector<Ray> scan = raysInRange(scans.at(i), ranges);
        rays.insert(rays.end(), scan.begin(), scan.end());
    }
    return collect(lookup, rays);
}

}  // namespace akimap::app
