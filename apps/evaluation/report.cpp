// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "evaluation/report.h"

#include <cmath>
#include <iomanip>
#include <sstream>
#include <utility>

namespace akimap::app {

namespace {

using nlohmann::ordered_json;

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

std::string shownSigned(double value) {
    if (std::abs(value) < 5e-5) return shown(0);  // not -0.0000
    return (value > 0 ? "+" : "") + shown(value);
}

/** A column of the table: a text for each figure, then the cells, then the coverage. */
using Column = std::vector<std::string>;

Column columnOf(const Scores& scores) {
    Column column;
    for (const auto& figure : figures(scores)) column.push_back(shown(figure.second));
    column.push_back(std::to_string(scores.cells));
    return column;
}

Column difference(const Scores& scores, const Scores& first) {
    const auto ours = figures(scores), theirs = figures(first);
    Column column;
    for (std::size_t i = 0; i < ours.size(); i++)
        column.push_back(shownSigned(ours[i].second - theirs[i].second));
    const auto cells = static_cast<long long>(scores.cells) - static_cast<long long>(first.cells);
    column.push_back((cells > 0 ? "+" : "") + std::to_string(cells));
    return column;
}

/** The known and all columns of a map, or of a difference of maps. */
struct Columns {
    std::string title;
    Column known, all;
};

void print(const std::vector<Columns>& groups, std::ostream& out) {
    const auto row = [&](const std::string& name, const auto& cell) {
        out << std::left << std::setw(20) << name << std::right;
        for (const Columns& g : groups) {
            const auto& [known, all] = cell(g);
            out << std::setw(10) << known << std::setw(10) << all;
        }
        out << "\n";
    };
    using Pair = std::pair<std::string, std::string>;
    if (groups.size() > 1) row("", [](const Columns& g) { return Pair("", g.title); });
    row("", [](const Columns&) { return Pair("known", "all"); });
    std::vector<std::string> names;
    for (const auto& figure : figures({})) names.push_back(figure.first);
    names.insert(names.end(), {"cells", "coverage"});
    for (std::size_t i = 0; i < names.size(); i++) {
        for (char& c : names[i])
            if (c == '_') c = ' ';
        row(names[i],
            [i](const Columns& g) { return Pair(g.known[i], i < g.all.size() ? g.all[i] : ""); });
    }
}

Columns columnsOf(const std::string& title, const Evaluation& e) {
    Columns columns{title, columnOf(e.known), columnOf(e.all)};
    columns.known.push_back(shown(e.coverage));
    return columns;
}

Columns differences(const std::string& title, const Evaluation& e, const Evaluation& first) {
    Columns columns{title, difference(e.known, first.known), difference(e.all, first.all)};
    columns.known.push_back(shownSigned(e.coverage - first.coverage));
    return columns;
}

void setIfFinite(ordered_json& entry, double value) {
    entry = nullptr;
    if (std::isfinite(value)) entry = value;
}

ordered_json toJson(const std::vector<RocPoint>& roc) {
    std::vector<double> false_positive_rate, true_positive_rate;
    for (const RocPoint& p : roc) {
        false_positive_rate.push_back(p.false_positive_rate);
        true_positive_rate.push_back(p.true_positive_rate);
    }
    return {{"false_positive_rate", false_positive_rate},
            {"true_positive_rate", true_positive_rate}};
}

ordered_json toJson(const Reliability& bins) {
    ordered_json json;
    for (const ReliabilityBin& bin : bins) {
        json["cells"].push_back(bin.cells);
        setIfFinite(json["mean_occupancy"].emplace_back(), bin.mean_occupancy);
        setIfFinite(json["occupied_fraction"].emplace_back(), bin.occupied_fraction);
    }
    return json;
}

ordered_json toJson(const Judgement& map) {
    ordered_json json{{"map", map.name}};
    json.update(toJson(map.evaluation));
    json["known_roc"] = toJson(map.known.roc);
    json["all_roc"] = toJson(map.all.roc);
    json["known_reliability"] = toJson(map.known.reliability);
    json["all_reliability"] = toJson(map.all.reliability);
    return json;
}

}  // namespace

Judgement judge(const std::string& name, ScoredCells cells) {
    const Curves known{roc(cells.known), reliability(cells.known)};
    const Curves all{roc(cells.all), reliability(cells.all)};
    return {name, score(std::move(cells)), known, all};
}

void printTable(const Evaluation& evaluation, std::ostream& out) {
    print({columnsOf("", evaluation)}, out);
}

void printTable(const std::vector<Judgement>& maps, std::ostream& out) {
    std::vector<Columns> groups;
    const auto number = [](std::size_t i) { return "[" + std::to_string(i + 1) + "]"; };
    for (std::size_t i = 0; i < maps.size(); i++) {
        if (maps.size() > 1) out << number(i) << " " << maps[i].name << "\n";
        groups.push_back(columnsOf(number(i), maps[i].evaluation));
    }
    for (std::size_t i = 1; i < maps.size(); i++)
        groups.push_back(
            differences(number(i) + " - " + number(0), maps[i].evaluation, maps[0].evaluation));
    print(groups, out);
}

ordered_json toJson(const Evaluation& evaluation) {
    ordered_json json;
    const auto add = [&](const std::string& prefix, const Scores& scores) {
        for (const auto& [name, value] : figures(scores)) setIfFinite(json[prefix + name], value);
        json[prefix + "cells"] = scores.cells;
    };
    add("known_", evaluation.known);
    add("all_", evaluation.all);
    setIfFinite(json["coverage"], evaluation.coverage);
    return json;
}

ordered_json toJson(const std::vector<Judgement>& maps) {
    ordered_json json = toJson(maps.front());
    for (std::size_t i = 1; i < maps.size(); i++) json["compare"].push_back(toJson(maps[i]));
    return json;
}

}  // namespace akimap::app
