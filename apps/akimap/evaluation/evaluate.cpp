// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "evaluation/evaluate.h"

#include <cmath>
#include <iomanip>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace akimap::app {

namespace {

/** The figures by name, in the order in which they are shown. */
std::vector<std::pair<std::string, double>> figures(const Scores& s) {
    return {{"auc", s.auc},
            {"mse", s.mse},
            {"log_loss", s.log_loss},
            {"calibration_error", s.calibration_error},
            {"precision_occupied", s.occupied.precision},
            {"recall_occupied", s.occupied.recall},
            {"f1_occupied", s.occupied.f1},
            {"precision_free", s.free.precision},
            {"recall_free", s.free.recall},
            {"f1_free", s.free.f1}};
}

std::string shown(double value) {
    if (!std::isfinite(value)) return "-";
    std::ostringstream text;
    text << std::fixed << std::setprecision(4) << value;
    return text.str();
}

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

void printTable(const Evaluation& evaluation, std::ostream& out) {
    const auto known = figures(evaluation.known), all = figures(evaluation.all);
    const auto row = [&](const std::string& name, const std::string& a, const std::string& b) {
        out << std::left << std::setw(20) << name << std::right << std::setw(12) << a
            << std::setw(12) << b << "\n";
    };
    row("", "known", "all");
    for (std::size_t i = 0; i < known.size(); i++) {
        std::string name = known[i].first;
        for (char& c : name)
            if (c == '_') c = ' ';
        row(name, shown(known[i].second), shown(all[i].second));
    }
    row("cells", std::to_string(evaluation.known.cells), std::to_string(evaluation.all.cells));
    row("coverage", shown(evaluation.coverage), "");
}

nlohmann::ordered_json toJson(const Evaluation& evaluation) {
    nlohmann::ordered_json json;
    const auto add = [&](const std::string& prefix, const Scores& scores) {
        for (const auto& [name, value] : figures(scores)) {
            auto& entry = json[prefix + name];
            if (std::isfinite(value)) entry = value;
        }
        json[prefix + "cells"] = scores.cells;
    };
    add("known_", evaluation.known);
    add("all_", evaluation.all);
    json["coverage"] = evaluation.coverage;
    return json;
}

}  // namespace akimap::app
