// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "report/figures.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "report/markdown.h"

namespace akimap::bench {
namespace {

using app::Evaluation;
using Better = Column::Better;

/** NaN if no row has a figure. */
double bestOf(const std::vector<Row>& rows, std::size_t column, Better better) {
    double best = std::numeric_limits<double>::quiet_NaN();
    if (better == Better::neither) return best;
    for (const Row& r : rows) {
        const double v = r.means[column];
        if (std::isnan(best) || (better == Better::higher ? v > best : v < best)) best = v;
    }
    return best;
}

bool isAsGood(double value, double best) {
    return std::abs(value - best) < 5e-4;  // the same in three decimals, or nearly
}

double deviation(const std::vector<double>& values, double mean) {
    double sum = 0;
    for (const double v : values) sum += (v - mean) * (v - mean);
    return std::sqrt(sum / static_cast<double>(values.size() - 1));
}

}  // namespace

const std::vector<Column>& accuracyColumns() {
    static const std::vector<Column> columns = {
        {"known AUC", [](const Evaluation& e) { return e.known.auc; }, Better::higher},
        {"known MSE", [](const Evaluation& e) { return e.known.mse; }, Better::lower},
        {"prec. occ.", [](const Evaluation& e) { return e.known.occupied.precision; },
         Better::higher},
        {"rec. occ.", [](const Evaluation& e) { return e.known.occupied.recall; }, Better::higher},
        {"prec. free", [](const Evaluation& e) { return e.known.free.precision; }, Better::higher},
        {"rec. free", [](const Evaluation& e) { return e.known.free.recall; }, Better::higher},
        {"all AUC", [](const Evaluation& e) { return e.all.auc; }, Better::higher},
        {"all MSE", [](const Evaluation& e) { return e.all.mse; }, Better::lower},
        {"coverage", [](const Evaluation& e) { return e.coverage; }, Better::higher},
    };
    return columns;
}

const std::vector<Column>& heldOutColumns() {
    static const std::vector<Column> columns = {
        {"known AUC", [](const Evaluation& e) { return e.known.auc; }, Better::higher},
        {"known Brier", [](const Evaluation& e) { return e.known.mse; }, Better::lower},
        {"known log-loss", [](const Evaluation& e) { return e.known.log_loss; }, Better::lower},
        {"known ECE", [](const Evaluation& e) { return e.known.calibration_error; }, Better::lower},
        {"all AUC", [](const Evaluation& e) { return e.all.auc; }, Better::higher},
        {"all Brier", [](const Evaluation& e) { return e.all.mse; }, Better::lower},
        {"all log-loss", [](const Evaluation& e) { return e.all.log_loss; }, Better::lower},
        {"all ECE", [](const Evaluation& e) { return e.all.calibration_error; }, Better::lower},
        {"coverage", [](const Evaluation& e) { return e.coverage; }, Better::higher},
    };
    return columns;
}

Row summarize(const std::string& name, const std::vector<Column>& columns,
              const std::vector<Evaluation>& runs) {
    Row row{name, {}, runs.size(), std::numeric_limits<double>::quiet_NaN(), {}};
    for (const Column& c : columns) {
        std::vector<double> values;
        for (const Evaluation& e : runs) values.push_back(c.value(e));
        double mean = 0;
        for (const double v : values) mean += v / static_cast<double>(values.size());
        row.means.push_back(mean);
        if (values.size() > 1)
            row.largest_deviation = std::fmax(row.largest_deviation, deviation(values, mean));
    }
    return row;
}

std::string tableOf(const std::vector<Row>& rows, const std::vector<Column>& columns,
                    const std::vector<std::string>& more, const std::string& where,
                    std::vector<std::pair<std::string, std::string>>& lost) {
    std::vector<std::string> header = {"method"};
    for (const Column& c : columns) header.emplace_back(c.name);
    header.insert(header.end(), {"σ ≤", "runs"});
    header.insert(header.end(), more.begin(), more.end());
    MarkdownTable table(header);
    std::vector<double> best;
    for (std::size_t i = 0; i < columns.size(); i++)
        best.push_back(bestOf(rows, i, columns[i].better));
    for (const Row& r : rows) {
        std::vector<std::string> cells = {r.name};
        for (std::size_t i = 0; i < columns.size(); i++) {
            const std::string text = fixed(r.means[i], 3);
            cells.push_back(isAsGood(r.means[i], best[i]) ? bold(text) : text);
        }
        cells.push_back(fixed(r.largest_deviation, 3));
        cells.push_back(std::to_string(r.runs));
        cells.insert(cells.end(), r.more.begin(), r.more.end());
        table.add(std::move(cells));
    }
    for (std::size_t i = 0; i < columns.size(); i++) {
        if (std::isnan(best[i]) || isAsGood(rows.front().means[i], best[i])) continue;
        const auto winner = std::find_if(rows.begin(), rows.end(),
                                         [&](const Row& r) { return r.means[i] == best[i]; });
        lost.emplace_back(where, std::string(columns[i].name) + " " +
                                     fixed(rows.front().means[i], 3) + " (" + winner->name + ": " +
                                     fixed(best[i], 3) + ")");
    }
    return table.text();
}

app::Figure rocOfKnown(const std::vector<app::Judgement>& maps) {
    app::Figure figure = app::rocFigure(maps);
    auto& curves = figure.panels.front().curves;
    const auto is_all = [](const app::Curve& c) { return c.dashed; };
    curves.erase(std::remove_if(curves.begin(), curves.end(), is_all), curves.end());
    return figure;
}

}  // namespace akimap::bench
