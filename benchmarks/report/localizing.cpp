// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "report/localizing.h"

#include <cmath>
#include <limits>

#include "quantile.h"
#include "report/figures.h"
#include "report/markdown.h"

namespace akimap::bench {
namespace {

double median(const std::vector<double>& values) {
    return app::quantile(values, 0.5);
}

}  // namespace

std::string localizationSection(Report& report, const LocalizationCase& recording,
                                const LocalizationRules& rules) {
    const std::vector<PoseEstimates> all = localize(recording, rules, report.doing);
    std::vector<std::string> names, header{"map"};
    std::vector<std::vector<std::string>> rows;
    for (const PoseEstimates& e : all)
        if (e.method == all.front().method) names.push_back(e.map), rows.push_back({e.map});
    for (const std::string method : {"ICP", "likelihood"}) {
        Contested good{method + ": good", Better::higher, {}},
            place{method + " [mm]", Better::lower, {}, 1},
            angle{method + " [deg]", Better::lower, {}, 2},
            time{method + " [ms]", Better::neither, {}, 0};
        for (const PoseEstimates& e : all) {
            if (e.method != method) continue;
            good.values.push_back(e.good());
            place.values.push_back(1e3 * median(e.metres));
            angle.values.push_back(180 / M_PI * median(e.radians));
            time.values.push_back(1e3 * median(e.seconds));
        }
        for (const Contested& figure : {good, place, angle, time}) {
            header.push_back(figure.name);
            const auto cells = cellsOf(figure, names, names.size(),
                                       recording.name + ", localization", report.lost);
            for (std::size_t i = 0; i < rows.size(); i++) rows[i].push_back(cells[i]);
        }
    }
    MarkdownTable table(header);
    for (auto& row : rows) table.add(std::move(row));
    return std::to_string(all.front().metres.size()) + " starts.\n\n" + table.text();
}

std::string localizationLegend(const LocalizationRules& rules) {
    return "Where was the sensor? Every fifth scan is looked for in maps of the others, from "
           "starts up to " +
           fixed(rules.offset, 2) + " m off along each axis and " +
           fixed(180 / M_PI * rules.angle, 0) + " degrees about each, by at most " +
           std::to_string(rules.returns) +
           " of its returns. ICP: mrpt::slam::CICP, by the map's determineMatching3D(), which "
           "COctoMap has not. Likelihood: the maximum of computeObservationLikelihood() that a "
           "climb from the start finds, step by step along each axis. Good: within 5 cm and 2 "
           "degrees of the recorded pose, which "
           "has errors of its own; the errors are medians over all starts, the times too.\n";
}

}  // namespace akimap::bench
