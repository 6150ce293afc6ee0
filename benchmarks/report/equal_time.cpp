// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "report/equal_time.h"

#include <algorithm>
#include <array>
#include <random>

#include "report/figures.h"
#include "report/markdown.h"

namespace akimap::bench {
namespace {

constexpr int kSteps = 20;  // of 5 %
constexpr double kSlack = 1.05;

/** One method's time for all data. */
struct Budget {
    std::string setter;  ///< that method
    double seconds = 0;
};

using ThinnedScans = std::vector<std::vector<PreparedScan>>;  // by steps - 1

double medianSeconds(const Method& method, const Scene& scene,
                     const std::vector<PreparedScan>& scans) {
    std::array<double, 3> seconds;
    for (double& s : seconds) s = build(method, settingsFor(scene, 1), scans).seconds;
    std::sort(seconds.begin(), seconds.end());
    return seconds[1];
}

/** The most steps of data that fit the budget; one if none does. */
int stepsWithin(const Budget& budget, const Method& method, const Scene& scene,
                const ThinnedScans& thinned) {
    if (method.name == budget.setter) return kSteps;
    int fits = 1, over = kSteps + 1;
    while (over - fits > 1) {
        const int middle = (fits + over) / 2;
        const auto& scans = thinned[static_cast<std::size_t>(middle) - 1];
        (medianSeconds(method, scene, scans) <= kSlack * budget.seconds ? fits : over) = middle;
    }
    return fits;
}

std::string table(Report& report, const Scene& scene, const std::vector<Method>& methods,
                  const ThinnedScans& thinned, const Budget& budget, const std::string& name) {
    std::vector<Row> rows;
    std::vector<app::Judgement> judgements;
    for (const Method& m : methods) {
        report.doing(scene.name + ", equal time (" + fixed(budget.seconds, 2) + " s): " + m.name);
        const int steps = stepsWithin(budget, m, scene, thinned);
        const auto& scans = thinned[static_cast<std::size_t>(steps) - 1];
        std::vector<app::Evaluation> runs;
        double seconds = 0;
        const int seeds = m.random ? report.seeds : 1;
        const std::string label = m.name + " (" + std::to_string(5 * steps) + " %)";
        for (int seed = 1; seed <= seeds; seed++) {
            const auto built = build(m, settingsFor(scene, static_cast<uint64_t>(seed)), scans);
            app::ScoredCells cells =
                app::collect(lookupIn(*built.map), scene.truth.resolution, scene.truth, scene.box);
            seconds += built.seconds / seeds;
            if (seed == 1) judgements.push_back(app::judge(label, cells));
            runs.push_back(app::score(std::move(cells)));
        }
        rows.push_back(summarize(label, accuracyColumns(), runs));
        rows.back().more = {fixed(seconds, 3)};
    }
    const std::string picture = "equal_time_" + name;
    for (const char* extension : {".png", ".svg"})
        app::writeFigure(rocOfKnown(judgements), report.pictures + "/" + picture + extension);
    return tableOf(rows, accuracyColumns(), {"time [s]"},
                   scene.name + " in " + fixed(budget.seconds, 2) + " s", report.lost) +
           "\n" + image("ROC curves at equal time", report.pictures_link + "/" + picture + ".png");
}

}  // namespace

std::vector<PreparedScan> thin(const std::vector<std::vector<Ray>>& scans, double share,
                               double max_range) {
    std::vector<std::vector<Ray>> kept;
    std::mt19937 random(1);
    for (const auto& scan : scans) {
        std::vector<std::size_t> order(scan.size());
        for (std::size_t i = 0; i < order.size(); i++) order[i] = i;
        std::shuffle(order.begin(), order.end(), random);
        order.resize(static_cast<std::size_t>(share * static_cast<double>(scan.size()) + 0.5));
        std::sort(order.begin(), order.end());
        auto& rays = kept.emplace_back();
        for (const std::size_t i : order) rays.push_back(scan[i]);
    }
    return prepare(kept, max_range);
}

std::string equalTimeSection(Report& report, const Scene& scene, const std::string& name) {
    ThinnedScans thinned;
    for (int i = 1; i <= kSteps; i++)
        thinned.push_back(thin(scene.scans, i / double(kSteps), scene.max_range));
    std::vector<Method> methods = {akimapMethods().front()};
    std::vector<double> seconds;
    for (Method& m : otherMethods())
        if (m.name != "GMM-OM") methods.push_back(std::move(m));  // its fit alone takes longer
    Budget fastest, bgkl;
    for (const Method& m : methods) {
        if (m.name != "AkiMap" && m.name.rfind("BGK", 0) != 0) continue;
        report.doing(scene.name + ", budgets: " + m.name);
        const Budget own{m.name, medianSeconds(m, scene, thinned.back())};
        if (fastest.setter.empty() || own.seconds < fastest.seconds) fastest = own;
        if (m.name == "BGKOctoMap-L") bgkl = own;
    }
    std::string text = "In the time of the fastest kernel method, " + fastest.setter + ", " +
                       fixed(fastest.seconds, 3) + " s:\n\n";
    text += table(report, scene, methods, thinned, fastest, name + "_fastest");
    text += "\nIn BGKOctoMap-L's time, " + fixed(bgkl.seconds, 3) + " s, as in the paper:\n\n";
    return text + table(report, scene, methods, thinned, bgkl, name + "_bgkl");
}

}  // namespace akimap::bench
