// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "report/heldout.h"

#include "evaluation/holdout.h"
#include "evaluation/report.h"
#include "report/figures.h"
#include "report/markdown.h"

namespace akimap::bench {
namespace {

constexpr std::size_t kEvery = 5;

}  // namespace

std::string heldOutSection(Report& report, const Scene& scene, const std::string& name) {
    std::vector<PreparedScan> used;
    std::vector<Ray> judges;
    const std::vector<PreparedScan> all = prepare(scene.scans, scene.max_range);
    for (std::size_t i = 0; i < all.size(); i++) {
        if (app::isHeldOut(i, kEvery))
            judges.insert(judges.end(), all[i].rays.begin(), all[i].rays.end());
        else
            used.push_back(all[i]);
    }
    std::vector<Method> methods = akimapMethods();
    for (Method& m : otherMethods()) methods.push_back(std::move(m));
    std::vector<Row> rows;
    std::vector<app::Judgement> judgements;
    for (const Method& m : methods) {
        report.doing(scene.name + ", held-out scans: " + m.name);
        std::vector<app::Evaluation> runs;
        for (std::size_t seed = 1; seed <= runsOf(m, 1, report.seeds); seed++) {
            const auto built = build(m, settingsFor(scene, seed), used);
            app::ScoredCells cells = app::collect(lookupIn(*built.map), judges);
            if (seed == 1) judgements.push_back(app::judge(m.name, cells));
            runs.push_back(app::score(std::move(cells)));
        }
        rows.push_back(summarize(m.name, heldOutColumns(), runs));
    }
    for (const char* extension : {".png", ".svg"})
        app::writeFigure(app::calibrationFigure(judgements),
                         report.pictures + "/reliability_" + name + extension);
    return std::to_string(used.size()) + " scans in, " + std::to_string(all.size() - used.size()) +
           " held out.\n\n" +
           tableOf(rows, heldOutColumns(), {}, scene.name + ", held-out scans", report.lost) +
           "\n" + image("Reliability", report.pictures_link + "/reliability_" + name + ".png");
}

}  // namespace akimap::bench
