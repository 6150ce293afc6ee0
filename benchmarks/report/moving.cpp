// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "report/moving.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "quantile.h"
#include "report/markdown.h"

namespace akimap::bench {
namespace {

constexpr std::size_t kLater[] = {1, 5, 10, 20, 50};  // scans after someone has left

/** Mean over the scans while someone is there. */
double meanThen(const std::vector<std::size_t>& counts, const WatchedWalk& walk) {
    double sum = 0, scans = 0;
    for (std::size_t i = 0; i < walk.gone; i++)
        if (!walk.scans[i].someone.empty()) sum += static_cast<double>(counts[i]), scans++;
    return sum / scans;
}

std::vector<std::string> row(const std::string& name, const Residue& residue,
                             const WatchedWalk& walk) {
    std::vector<std::string> cells{name, fixed(meanThen(residue.present, walk), 0),
                                   fixed(meanThen(residue.cells, walk), 0)};
    for (const std::size_t later : kLater) {
        const std::size_t scan = walk.gone + later - 1;
        cells.push_back(scan < residue.cells.size() ? std::to_string(residue.cells[scan]) : "–");
    }
    cells.push_back(fixed(app::quantile(residue.waits, 0.5), 0));
    cells.push_back(fixed(app::quantile(residue.waits, 0.9), 0));
    cells.push_back(std::to_string(residue.never) + " of " +
                    std::to_string(residue.never + residue.waits.size()));
    return cells;
}

}  // namespace

std::string movingSection(Report& report, const WatchedWalk& walk) {
    std::vector<std::string> header{"method", "where they are", "where they were"};
    for (const std::size_t later : kLater)
        header.push_back(std::to_string(later) + (later == 1 ? " scan later" : " scans later"));
    for (const char* name : {"scans until free, median", "90th percentile", "never free"})
        header.emplace_back(name);
    MarkdownTable table(header);
    MapSettings settings;
    settings.resolution = walk.resolution, settings.max_range = walk.max_range;
    const auto akimap = akimapMethods();
    for (const Method& method : {akimap[0], akimap[1], otherMethods().front()}) {
        report.doing(walk.name + ": " + method.name);
        const auto map = method.make(settings);
        table.add(row(method.name, watch(*map, walk), walk));
    }
    return table.text();
}

}  // namespace akimap::bench
