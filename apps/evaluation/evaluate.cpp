// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "evaluation/evaluate.h"

#include <cmath>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace akimap::app {

namespace {

void checkScorable(double resolution, const Truth& truth, const Box& box) {
    std::ostringstream why;
    if (!(std::abs(truth.resolution - resolution) <= 1e-6 * resolution))
        why << "the truth's resolution of " << truth.resolution << " m is not the map's, "
            << resolution << " m";
    else if (const double cells = truth.countCells(box); cells == 0)
        why << "no cell of the truth to score (is the box right?)";
    else if (cells > kMaxScoredCells)
        why << cells << " cells to score are more than " << kMaxScoredCells
            << ": give a smaller box";
    if (!why.str().empty()) throw std::runtime_error(why.str());
}

}  // namespace

OccupancyLookup lookupIn(const AkiMap& map) {
    return [&map](double x, double y, double z) { return map.occupancy(x, y, z); };
}

OccupancyLookup lookupIn(const mrpt::maps::COctoMap& map) {
    return [&map](double x, double y, double z) -> std::optional<double> {
        double occupancy = 0;
        if (!map.getPointOccupancy(static_cast<float>(x), static_cast<float>(y),
                                   static_cast<float>(z), occupancy))
            return std::nullopt;
        return occupancy;
    };
}

OccupancyLookup lookupIn(const octomap::OcTree& tree) {
    return [&tree](double x, double y, double z) -> std::optional<double> {
        const auto* node = tree.search(x, y, z);
        if (!node) return std::nullopt;
        return node->getOccupancy();
    };
}

ScoredCells collect(const OccupancyLookup& lookup, double resolution, const Truth& truth,
                    const Box& box) {
    checkScorable(resolution, truth, box);
    ScoredCells cells;
    cells.all.reserve(static_cast<std::size_t>(truth.countCells(box)));
    truth.forEachCell(box, [&](double x, double y, double z, bool occupied) {
        const std::optional<double> occupancy = lookup(x, y, z);
        if (occupancy && !(*occupancy >= 0 && *occupancy <= 1))
            throw std::runtime_error("the map holds an occupancy that is not in [0, 1]");
        if (occupancy) cells.known.push_back({*occupancy, occupied});
        cells.all.push_back({occupancy.value_or(0.5), occupied});
    });
    return cells;
}

Evaluation score(ScoredCells cells) {
    const double coverage =
        static_cast<double>(cells.known.size()) / static_cast<double>(cells.all.size());
    return {score(std::move(cells.known)), score(std::move(cells.all)), coverage};
}

Evaluation evaluate(const OccupancyLookup& lookup, double resolution, const Truth& truth,
                    const Box& box) {
    return score(collect(lookup, resolution, truth, box));
}

Evaluation evaluate(const AkiMap& map, const Truth& truth, const Box& box) {
    return evaluate(lookupIn(map), map.resolution(), truth, box);
}

Evaluation evaluate(const mrpt::maps::COctoMap& map, const Truth& truth, const Box& box) {
    return evaluate(lookupIn(map), map.getResolution(), truth, box);
}

}  // namespace akimap::app
