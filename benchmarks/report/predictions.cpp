// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "report/predictions.h"

#include <algorithm>

#include "evaluation/contest/depth_picture.h"
#include "report/figures.h"
#include "report/markdown.h"

namespace akimap::bench {
namespace {

using app::ContestResult;
using app::MapResult;
using app::RayShares;
using app::Scores;

/** A column of a table: a figure of each map. */
struct MapFigure {
    const char* name;
    Better better;
    double (*value)(const MapResult&);
    int decimals = 3;
};

double perScan(const MapResult& m) {
    return m.seconds / static_cast<double>(m.scans_inserted);
}

const std::vector<MapFigure>& rayColumns() {
    static const std::vector<MapFigure> columns = {
        {"near1", Better::higher, [](const MapResult& m) { return m.rays.shares().near1; }},
        {"near3", Better::higher, [](const MapResult& m) { return m.rays.shares().near3; }},
        {"early", Better::lower, [](const MapResult& m) { return m.rays.shares().early; }},
        {"phantom", Better::lower, [](const MapResult& m) { return m.rays.shares().phantom; }},
        {"late", Better::lower, [](const MapResult& m) { return m.rays.shares().late; }},
        {"miss", Better::lower, [](const MapResult& m) { return m.rays.shares().miss; }},
        {"unknown", Better::neither, [](const MapResult& m) { return m.rays.shares().unknown; }},
        {"depth [mm]", Better::lower,
         [](const MapResult& m) { return 1e3 * m.rays.shares().depth_error_median; }, 1},
        {"90 % [mm]", Better::lower,
         [](const MapResult& m) { return 1e3 * m.rays.shares().depth_error_90; }, 1},
        {"faithful", Better::higher, [](const MapResult& m) { return m.faithfulness.share(); }},
        {"nearby", Better::higher, [](const MapResult& m) { return m.faithfulness.shareNearby(); }},
        {"ms a scan", Better::neither, [](const MapResult& m) { return 1e3 * perScan(m); }, 1},
    };
    return columns;
}

const std::vector<MapFigure>& cellColumns() {
    static const std::vector<MapFigure> columns = {
        {"known to all: AUC", Better::higher,
         [](const MapResult& m) { return m.to_cell_clearance.common.auc; }},
        {"Brier", Better::lower, [](const MapResult& m) { return m.to_cell_clearance.common.mse; }},
        {"log-loss", Better::lower,
         [](const MapResult& m) { return m.to_cell_clearance.common.log_loss; }},
        {"F1 occ.", Better::higher,
         [](const MapResult& m) { return m.to_cell_clearance.common.occupied.f1; }},
        {"all: AUC", Better::higher,
         [](const MapResult& m) { return m.to_cell_clearance.all.auc; }},
        {"Brier ", Better::lower, [](const MapResult& m) { return m.to_cell_clearance.all.mse; }},
        {"log-loss ", Better::lower,
         [](const MapResult& m) { return m.to_cell_clearance.all.log_loss; }},
        {"F1 occ. ", Better::higher,
         [](const MapResult& m) { return m.to_cell_clearance.all.occupied.f1; }},
        {"known", Better::higher, [](const MapResult& m) { return m.to_cell_clearance.coverage; }},
    };
    return columns;
}

std::string tableOf(const ContestResult& result, const std::vector<MapFigure>& columns,
                    const std::string& where, Report& report) {
    std::vector<std::string> names, header{"method"};
    std::size_t competing = 0;
    for (const MapResult& m : result.maps) {
        names.push_back(m.name);
        competing += m.sees_held_out ? 0 : 1;
    }
    std::vector<std::vector<std::string>> rows;
    for (const std::string& name : names) rows.push_back({name});
    for (const MapFigure& column : columns) {
        Contested figure{column.name, column.better, {}, column.decimals};
        for (const MapResult& m : result.maps) figure.values.push_back(column.value(m));
        const auto cells = cellsOf(figure, names, competing, where, report.lost);
        for (std::size_t i = 0; i < rows.size(); i++) rows[i].push_back(cells[i]);
        header.emplace_back(column.name);
    }
    MarkdownTable table(header);
    for (auto& row : rows) table.add(std::move(row));
    return table.text();
}

std::string withSign(double value) {
    return (value < 0 ? "" : "+") + fixed(value, 3);
}

/** AkiMap's difference from OctoMap in the same scans. */
std::string differences(const ContestResult& result) {
    const MapResult* octomap = app::referenceOf(result);
    if (!octomap) return "";
    std::string text = "AkiMap less " + octomap->name + ", scan by scan (lowest to highest): ";
    const std::pair<const char*, double RayShares::*> figures[] = {{"near1 ", &RayShares::near1},
                                                                   {"near3 ", &RayShares::near3},
                                                                   {"early ", &RayShares::early}};
    for (const auto& [name, figure] : figures) {
        const auto d = app::pairedDifference(result.maps.front(), *octomap, figure);
        text += name + withSign(d.mean) + " (" + withSign(d.lowest) + " to " + withSign(d.highest) +
                ")" + (figure == &RayShares::early ? ".\n" : ", ");
    }
    return text;
}

StopShares stopsOf(const MapResult& map) {
    const RayShares s = map.rays.shares();
    return {s.near1, s.near3, s.early, s.phantom, s.miss};
}

std::string scansIn(const ContestResult& r) {
    return std::to_string(r.scans) + " scans, " + std::to_string(r.held_out) + " held out in " +
           std::to_string(r.folds) + (r.folds == 1 ? " fold, " : " folds, ") +
           std::to_string(r.maps.front().rays.rays()) + " rays cast.";
}

}  // namespace

ContestResult hold(const Trial& trial, const std::vector<std::vector<Ray>>& scans,
                   const std::function<void(const std::string&)>& doing, unsigned threads) {
    AkiMap configured(trial.resolution);
    configured.insertionOptions.max_range = trial.max_range;
    configured.insertionOptions.threads = threads;
    app::ContestRules rules = app::rulesFor(configured);
    rules.all_folds = trial.all_folds;
    const app::Recording all = app::recordingOf(scans);
    std::size_t fold = 0;  // the recording is read once for each
    const app::Recording told = [&](const auto& take) {
        doing(trial.name + ", held-out scans: fold " + std::to_string(++fold));
        all(take);
    };
    return app::holdContest(told, app::standardEntrants(configured), rules);
}

std::string predictionTables(Report& report, const std::string& where,
                             const ContestResult& result) {
    return scansIn(result) + "\n\n" + tableOf(result, rayColumns(), where, report) + "\n" +
           differences(result) + "\n" + tableOf(result, cellColumns(), where, report);
}

std::string predictionSection(Report& report, const Trial& trial) {
    const auto scans = trial.scans();
    if (scans.empty()) {
        report.doing(trial.name + ": not there, left out");
        return "";
    }
    const ContestResult result = hold(trial, scans, report.doing);
    if (const MapResult* octomap = app::referenceOf(result))
        report.real.push_back({trial.name, stopsOf(result.maps.front()), stopsOf(*octomap)});
    std::string text = "\n### " + trial.name + "\n\n" + trial.what + " " +
                       predictionTables(report, trial.name, result);
    if (!trial.has_picture) return text;
    const std::string picture = "/depth_" + trial.file + ".png";
    app::writeDepthPicture(result, report.pictures + picture, app::DepthSource::maps_alone);
    return text + "\n" +
           image("Depth by the maps, of a scan that they never got",
                 report.pictures_link + picture);
}

std::string predictionLegend() {
    return "Each return of the held-out scans, at most " + std::to_string(app::kMostReturns) +
           " a scan, is cast from its origin to four cells behind it; the first cell with p > 0.5 "
           "stops it. Shares of the rays: near1, near3: stopped within 1.5, 3.5 cells of the "
           "return; early, late: farther before, behind it; phantom: the early ones with no "
           "held-out return within one cell of the cell that stops them; miss: not stopped; "
           "unknown: of these, no evidence at the return. Depth: error of the rays stopped, "
           "median and 90th percentile. Faithful: of the cells with " +
           std::to_string(app::kFaithfulReturns) +
           " or more returns of the map's own scans, the share that is occupied; nearby: or has an "
           "occupied neighbour. Below: what the maps say of the returns (occupied) and of one "
           "place every half metre and one 1.5 cells before them (free): over the places that all "
           "the maps have evidence for, then over all, p = 0.5 without evidence; known: the share "
           "of a map's own. Time is insertion, one thread. AkiMap: its defaults; paper: estimator "
           "= paper; isotropic: its bandwidth = isotropic; OctoMap: its library's "
           "insertPointCloud(), discretized; TSDF: a plain truncated signed distance field, the "
           "strongest predictor, which has no evidence to give; OctoMap+: OctoMap that got the "
           "held-out scans too, a yardstick of what is possible, no contestant. Pictures: one scan "
           "each, its depth by the maps and where they differ from it.\n";
}

}  // namespace akimap::bench
