// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "report/on_the_fly.h"

#include <mrpt/system/CTicTac.h>

#include <algorithm>
#include <thread>

#include "mapping/RealtimeGate.h"
#include "pictures/plot/plot.h"
#include "quantile.h"
#include "report/markdown.h"

namespace akimap::bench {
namespace {

constexpr double kLidarRange = 10;  // [m], as in the paper

struct Run {
    app::RealtimeGate gate;
    std::vector<double> milliseconds;  // of the updates
};

Run replay(const Method& method, const MapSettings& settings,
           const std::vector<PreparedScan>& scans, double rate) {
    Run run;
    const auto map = method.make(settings);
    for (std::size_t i = 0; i < scans.size(); i++) {
        if (!run.gate.offer(static_cast<double>(i) / rate)) continue;
        mrpt::system::CTicTac clock;
        map->insert(scans[i]);
        const double seconds = clock.Tac();
        run.gate.used(seconds);
        run.milliseconds.push_back(1e3 * seconds);
    }
    return run;
}

/** In bins of 25 ms from 0. */
app::Bars histogram(const std::string& name, const std::vector<double>& milliseconds) {
    constexpr double kBin = 25;
    app::Bars bars{name, {0}, {}, 0};
    for (const double t : milliseconds) {
        const auto bin = static_cast<std::size_t>(t / kBin);
        while (bars.heights.size() <= bin) {
            bars.heights.push_back(0);
            bars.edges.push_back(bars.edges.back() + kBin);
        }
        bars.heights[bin]++;
    }
    return bars;
}

}  // namespace

std::string onTheFlySection(Report& report, const LidarDrive& drive, const std::string& name) {
    const std::vector<PreparedScan> scans = prepare(drive.scans, kLidarRange);
    MapSettings settings;
    settings.max_range = kLidarRange;
    struct Case {
        Method method;
        unsigned threads;
        std::string label;
    };
    const unsigned cores = std::max(1u, std::thread::hardware_concurrency());
    const Method akimap = akimapMethods().front(), octomap = otherMethods().front();
    std::vector<Case> cases = {{akimap, 1, "AkiMap, 1 thread"}, {octomap, 1, octomap.name}};
    if (cores > 1)
        cases.insert(cases.begin(),
                     {akimap, cores, "AkiMap, " + std::to_string(cores) + " threads"});

    MarkdownTable table(
        {"method", "offered", "used", "lost", "update, median [ms]", "99th percentile [ms]"});
    app::Panel panel;
    panel.x = {"update time [ms]", 0.0, std::nullopt, false}, panel.y = {"updates", 0.0, {}, false};
    for (std::size_t i = 0; i < cases.size(); i++) {
        report.doing(drive.name + ", on the fly: " + cases[i].label);
        settings.threads = cases[i].threads;
        const Run run = replay(cases[i].method, settings, scans, drive.rate);
        const double median = app::quantile(run.milliseconds, 0.5);
        const uint64_t lost = run.gate.lost();
        table.add({cases[i].label, std::to_string(run.gate.offered()),
                   std::to_string(run.gate.used()), std::to_string(lost), fixed(median, 1),
                   fixed(app::quantile(run.milliseconds, 0.99), 1)});
        if (i == 0 && lost > 0)
            report.lost.emplace_back(drive.name + ", on the fly",
                                     cases[i].label + " lose " + std::to_string(lost) + " of " +
                                         std::to_string(run.gate.offered()) + " scans");
        panel.bars.push_back(histogram(cases[i].label, run.milliseconds));
        panel.bars.back().color = i;
    }
    app::Figure figure;
    figure.title = "Update times, " + drive.name;
    figure.panels = {panel};
    const std::string picture = "updates_" + name;
    for (const char* extension : {".png", ".svg"})
        app::writeFigure(figure, report.pictures + "/" + picture + extension);
    return table.text() + "\n" +
           image("Update times", report.pictures_link + "/" + picture + ".png");
}

}  // namespace akimap::bench
