// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <set>
#include <sstream>
#include <stdexcept>

#include "evaluation/report.h"

namespace akimap::app {

namespace {

/** The names of the maps' files; with their folders if two would be the same. */
std::vector<std::string> shortNames(const std::vector<Judgement>& maps) {
    std::vector<std::string> names;
    for (const Judgement& map : maps)
        names.push_back(std::filesystem::path(map.name).filename().string());
    if (std::set<std::string>(names.begin(), names.end()).size() < names.size())
        for (std::size_t i = 0; i < maps.size(); i++) names[i] = maps[i].name;
    return names;
}

std::string withFigure(const std::string& name, const char* figure, double value) {
    if (!std::isfinite(value)) return name;
    std::ostringstream text;
    text << name << " (" << figure << " " << std::fixed << std::setprecision(3) << value << ")";
    return text.str();
}

Curve rocCurve(const std::string& name, const std::vector<RocPoint>& points, std::size_t color) {
    Curve curve;
    curve.name = name;
    curve.color = color;
    for (const RocPoint& p : points) {
        curve.x.push_back(p.false_positive_rate);
        curve.y.push_back(p.true_positive_rate);
    }
    return curve;
}

}  // namespace

Figure rocFigure(const std::vector<Judgement>& maps) {
    Panel panel;
    panel.x = {"false positive rate", 0, 1};
    panel.y = {"true positive rate", 0, 1};
    panel.diagonal = true;
    const auto names = shortNames(maps);
    for (std::size_t i = 0; i < maps.size(); i++) {
        const auto add = [&](const char* set, const Curves& curves, double auc, bool dashed) {
            if (curves.roc.empty()) return;
            panel.curves.push_back(
                rocCurve(withFigure(names[i] + ", " + set, "AUC", auc), curves.roc, i));
            panel.curves.back().dashed = dashed;
        };
        add("known", maps[i].known, maps[i].evaluation.known.auc, false);
        add("all", maps[i].all, maps[i].evaluation.all.auc, true);
    }
    if (panel.curves.empty())
        throw std::runtime_error("no ROC curve: the cells are all occupied or all free");
    Figure figure;
    figure.title = "ROC of occupied cells";
    figure.height = 600;
    figure.panels = {panel};
    return figure;
}

Figure calibrationFigure(const std::vector<Judgement>& maps) {
    Panel fractions, counts;
    fractions.x = {"", 0, 1};
    fractions.y = {"fraction truly occupied", 0, 1};
    fractions.diagonal = true;
    fractions.share = 2.8;
    counts.x = {"occupancy given by the map", 0, 1};
    counts.y = {"cells", 0.5, {}, true};
    const auto names = shortNames(maps);
    for (std::size_t i = 0; i < maps.size(); i++) {
        Curve curve;
        Bars bars;
        curve.name = withFigure(names[i], "ECE", maps[i].evaluation.known.calibration_error);
        curve.color = bars.color = i;
        curve.markers = true;
        bars.edges = {0};
        for (const ReliabilityBin& bin : maps[i].known.reliability) {
            curve.x.push_back(bin.mean_occupancy);
            curve.y.push_back(bin.occupied_fraction);
            bars.heights.push_back(static_cast<double>(bin.cells));
            bars.edges.push_back(static_cast<double>(bars.edges.size()) / 10);
        }
        fractions.curves.push_back(curve);
        counts.bars.push_back(bars);
    }
    Figure figure;
    figure.title = "Reliability of the occupancy of known cells";
    figure.height = 680;
    figure.panels = {fractions, counts};
    return figure;
}

}  // namespace akimap::app
