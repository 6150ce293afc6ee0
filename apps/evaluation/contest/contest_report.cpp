// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "evaluation/contest/contest_report.h"

#include <mrpt/core/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace akimap::app {

namespace {

using nlohmann::ordered_json;
using TextOf = std::function<std::string(const MapResult&)>;

/** The figures by cells, with their names in tables and in JSON. */
struct CellFigure {
    const char *name, *key;
    double (*value)(const Scores&);
};
constexpr CellFigure kCellFigures[] = {
    {"AUC", "auc", [](const Scores& s) { return s.auc; }},
    {"Brier score", "brier", [](const Scores& s) { return s.mse; }},
    {"log-loss", "log_loss", [](const Scores& s) { return s.log_loss; }},
    {"calibration error", "calibration_error", [](const Scores& s) { return s.calibration_error; }},
    {"F1 occupied", "f1_occupied", [](const Scores& s) { return s.occupied.f1; }}};

struct QuerySet {
    const char *name, *key;
    CellScores MapResult::*scores;
};
constexpr QuerySet kQuerySets[] = {
    {"free up to 1.5 cells before a return", "cells_to_1.5_cells", &MapResult::to_cell_clearance},
    {"free up to 0.2 m before a return", "cells_to_0.2_m", &MapResult::to_fixed_clearance}};

struct Scope {
    const char *name, *key;
    Scores CellScores::*scores;
};
constexpr Scope kScopes[] = {{"Queries that all maps know", "common", &CellScores::common},
                             {"Queries that each map knows", "known", &CellScores::known},
                             {"All queries", "all", &CellScores::all}};

std::string number(double value, const char* format = "%.3f") {
    return std::isfinite(value) ? mrpt::format(format, value) : "-";
}

class Table {
 public:
    Table(const ContestResult& result, std::ostream& out) : result_(result), out_(out) {}

    void heading(const std::string& title) {
        out_ << "\n" << title << "\n";
        row("", [](const MapResult& m) { return m.name; });
    }
    void row(const std::string& name, const TextOf& text) {
        out_ << mrpt::format("%-22s", name.c_str());
        for (const MapResult& map : result_.maps) out_ << mrpt::format("%11s", text(map).c_str());
        out_ << "\n";
    }

 private:
    const ContestResult& result_;
    std::ostream& out_;
};

/** A length is shown in millimetres. */
double shownValue(const RayFigure& f, double value) {
    return f.is_length ? 1000 * value : value;
}

void printRays(const ContestResult& result, Table& table) {
    table.heading("Rays of the held-out scans: where the map stops them, shares of " +
                  std::to_string(result.maps.front().rays.rays()));
    for (const RayFigure& f : rayFigures())
        table.row(f.name, [&](const MapResult& m) {
            return number(shownValue(f, m.rays.shares().*f.value), f.is_length ? "%.1f" : "%.3f");
        });
}

/** The figures that decide; JSON has the others' differences too. */
bool isCompared(const RayFigure& f) {
    const std::string key = f.key;
    return key != "late" && key != "unknown" && key != "depth_error_90";
}

void printDifferences(const ContestResult& result, Table& table) {
    const MapResult* reference = referenceOf(result);
    if (!reference) return;
    table.heading("Difference from " + reference->name + " in the same scan: mean of " +
                  std::to_string(reference->by_scan.size()) + ", lowest, highest");
    const auto add = [&](const RayFigure& f, const char* name, double PairedDifference::*part) {
        table.row(name, [&](const MapResult& m) {
            if (&m == reference) return std::string();
            return number(shownValue(f, pairedDifference(m, *reference, f.value).*part),
                          f.is_length ? "%+.1f" : "%+.3f");
        });
    };
    for (const RayFigure& f : rayFigures()) {
        if (!isCompared(f)) continue;
        add(f, f.name, &PairedDifference::mean);
        add(f, "  lowest", &PairedDifference::lowest);
        add(f, "  highest", &PairedDifference::highest);
    }
}

void printFaithfulness(const ContestResult& result, Table& table) {
    table.heading("Faithfulness: of the " + std::to_string(result.maps.front().faithfulness.cells) +
                  " cells with " + std::to_string(kFaithfulReturns) +
                  " or more returns of the other scans, the share that is occupied");
    table.row("the cell itself", [](const MapResult& m) { return number(m.faithfulness.share()); });
    table.row("or within one cell",
              [](const MapResult& m) { return number(m.faithfulness.shareNearby()); });
}

void printCells(const QuerySet& set, const Scope& scope, Table& table) {
    table.heading(std::string(scope.name) + ", " + set.name);
    const auto scoresOfMap = [&](const MapResult& m) -> const Scores& {
        return m.*set.scores.*scope.scores;
    };
    for (const CellFigure& f : kCellFigures)
        table.row(f.name, [&](const MapResult& m) { return number(f.value(scoresOfMap(m))); });
    table.row("queries", [&](const MapResult& m) { return std::to_string(scoresOfMap(m).cells); });
}

ordered_json jsonOf(const CellScores& scores) {
    ordered_json json;
    for (const Scope& scope : kScopes) {
        const Scores& s = scores.*scope.scores;
        for (const CellFigure& f : kCellFigures) json[scope.key][f.key] = f.value(s);
        json[scope.key]["queries"] = s.cells;
    }
    json["coverage"] = scores.coverage;
    return json;
}

ordered_json jsonOf(const RayShares& shares) {
    ordered_json json;
    for (const RayFigure& f : rayFigures()) json[f.key] = shares.*f.value;
    return json;
}

ordered_json differencesOf(const MapResult& map, const MapResult& reference) {
    ordered_json json;
    for (const RayFigure& f : rayFigures()) {
        const PairedDifference d = pairedDifference(map, reference, f.value);
        json[f.key] = {{"mean", d.mean}, {"lowest", d.lowest}, {"highest", d.highest}};
    }
    return json;
}

ordered_json jsonOf(const MapResult& map, const MapResult* reference) {
    ordered_json json{{"what", map.what}};
    json["rays"] = jsonOf(map.rays.shares());
    json["faithfulness"] = {{"cells", map.faithfulness.cells},
                            {"occupied", map.faithfulness.share()},
                            {"occupied_within_one_cell", map.faithfulness.shareNearby()}};
    for (const QuerySet& set : kQuerySets) json[set.key] = jsonOf(map.*set.scores);
    json["seconds_per_scan"] = map.seconds / static_cast<double>(map.scans_inserted);
    if (reference && reference != &map)
        json["difference_from_" + reference->name] = differencesOf(map, *reference);
    for (const ScanShares& s : map.by_scan) {
        ordered_json scan{{"scan", s.scan + 1}};
        scan.update(jsonOf(s.shares));
        json["scans"].push_back(scan);
    }
    return json;
}

}  // namespace

void printTable(const ContestResult& result, std::ostream& out) {
    out << result.scans << " scans, " << result.held_out << " of them held out";
    if (result.folds > 1) out << ", in " << result.folds << " folds";
    out << mrpt::format("; cells of %g m, returns up to %g m\n", result.rules.resolution,
                        result.rules.ranges.max_range);
    for (const MapResult& map : result.maps)
        out << mrpt::format("  %-11s", map.name.c_str()) << map.what << "\n";
    Table table(result, out);
    printRays(result, table);
    printDifferences(result, table);
    printFaithfulness(result, table);
    for (const QuerySet& set : kQuerySets)
        for (const Scope& scope : kScopes) printCells(set, scope, table);
    table.heading("Time to insert a scan");
    table.row("mean [ms]", [](const MapResult& m) {
        return number(1000 * m.seconds / static_cast<double>(m.scans_inserted), "%.1f");
    });
}

ordered_json toJson(const ContestResult& result) {
    ordered_json json{{"scans", result.scans},
                      {"scans_held_out", result.held_out},
                      {"folds", result.folds},
                      {"resolution", result.rules.resolution},
                      {"max_range", result.rules.ranges.max_range},
                      {"rays", result.maps.front().rays.rays()}};
    const MapResult* reference = referenceOf(result);
    for (const MapResult& map : result.maps) json["maps"][map.name] = jsonOf(map, reference);
    return json;
}

}  // namespace akimap::app
