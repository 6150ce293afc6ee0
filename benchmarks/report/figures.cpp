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

/** NaN if no value is a number. */
double bestOf(const Contested& figure, std::size_t competing) {
    double best = std::numeric_limits<double>::quiet_NaN();
    if (figure.better == Better::neither) return best;
    for (std::size_t i = 0; i < competing; i++) {
        const double v = figure.values[i];
        best = figure.better == Better::higher ? std::fmax(best, v) : std::fmin(best, v);
    }
    return best;
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

std::vector<std::string> cellsOf(const Contested& figure, const std::vector<std::string>& methods,
                                 std::size_t competing, const std::string& where,
                                 std::vector<std::pair<std::string, std::string>>& lost) {
    const double best = bestOf(figure, competing);
    const double same = 0.5 * std::pow(10.0, -figure.decimals);  // as printed, or nearly
    std::vector<std::string> cells;
    std::string winner;
    for (std::size_t i = 0; i < methods.size(); i++) {
        const bool is_best = i < competing && std::abs(figure.values[i] - best) < same;
        if (is_best && winner.empty()) winner = methods[i];
        const std::string text = fixed(figure.values[i], figure.decimals);
        cells.push_back(is_best ? bold(text) : text);
    }
    const bool is_first_best = winner == methods.front();
    if (!winner.empty() && !is_first_best)
        lost.emplace_back(where, figure.name + " " + fixed(figure.values[0], figure.decimals) +
                                     " (" + winner + ": " + fixed(best, figure.decimals) + ")");
    return cells;
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
    std::vector<std::string> names;
    for (const Row& r : rows) names.push_back(r.name);
    std::vector<std::vector<std::string>> cells;  // by column
    for (std::size_t i = 0; i < columns.size(); i++) {
        Contested figure{columns[i].name, columns[i].better, {}};
        for (const Row& r : rows) figure.values.push_back(r.means[i]);
        cells.push_back(cellsOf(figure, names, rows.size(), where, lost));
    }
    for (std::size_t r = 0; r < rows.size(); r++) {
        std::vector<std::string> row = {names[r]};
        for (const auto& column : cells) row.push_back(column[r]);
        row.push_back(fixed(rows[r].largest_deviation, 3));
        row.push_back(std::to_string(rows[r].runs));
        row.insert(row.end(), rows[r].more.begin(), rows[r].more.end());
        table.add(std::move(row));
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
