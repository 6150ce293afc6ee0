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

constexpr double kSpacing = 0.5;         // [m] of the free places
constexpr double kClearance = 0.2;       // [m] between the last of them and the end
constexpr double kCloseClearance = 1.5;  // [cells] in the closer set
constexpr double kRounding = 1e-9;       // [m] poses are applied in floating point

std::size_t freeCount(double length, double clearance = kClearance) {
    const double room = length - clearance + kRounding;
    return room < kSpacing ? 0 : static_cast<std::size_t>(room / kSpacing);
}

/** A place [m] at a distance from the origin. */
Query freeAt(const Ray& ray, double length, double distance) {
    const double fraction = distance / length;
    std::array<double, 3> place;
    for (std::size_t i = 0; i < 3; i++)
        place[i] = ray.origin[i] + fraction * (ray.end[i] - ray.origin[i]);
    return {place, false};
}

std::vector<Query> freeQueries(const Ray& ray, double length, double clearance) {
    std::vector<Query> queries;
    for (std::size_t k = 1; k <= freeCount(length, clearance); k++)
        queries.push_back(freeAt(ray, length, kSpacing * static_cast<double>(k)));
    return queries;
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
    std::vector<Query> queries = freeQueries(ray, lengthOf(ray), kClearance);
    queries.push_back({ray.end, true});
    return queries;
}

std::vector<Query> closeQueriesOf(const Ray& ray, double resolution) {
    const double length = lengthOf(ray), clearance = kCloseClearance * resolution;
    std::vector<Query> queries = freeQueries(ray, length, clearance);
    if (length > clearance) queries.push_back(freeAt(ray, length, length - clearance));
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

}  // namespace akimap::app
