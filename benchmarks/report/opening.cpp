// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
// What the report opens with.
#include <algorithm>

#include "report/contents.h"
#include "report/markdown.h"

namespace akimap::bench {
namespace {

std::string countOf(const std::vector<HeadToHead>& all, bool (*is)(const HeadToHead&)) {
    return std::to_string(std::count_if(all.begin(), all.end(), is)) + " of the " +
           std::to_string(all.size());
}

bool blocksMore(const HeadToHead& h) {
    return h.akimap.early > h.octomap.early;
}
bool isLessExact(const HeadToHead& h) {
    return h.akimap.near1 < h.octomap.near1;
}
bool isLessNear(const HeadToHead& h) {
    return h.akimap.near3 < h.octomap.near3;
}
bool losesAll(const HeadToHead& h) {
    return blocksMore(h) && isLessExact(h) && isLessNear(h);
}

std::string againstOctoMap(const std::vector<HeadToHead>& all) {
    MarkdownTable table({"AkiMap / OctoMap", "near1", "near3", "early", "phantom", "miss"});
    const auto both = [](double ours, double theirs) {
        return fixed(ours, 3) + " / " + fixed(theirs, 3);
    };
    for (const HeadToHead& h : all) {
        const StopShares &a = h.akimap, &o = h.octomap;
        table.add({h.recording, both(a.near1, o.near1), both(a.near3, o.near3),
                   both(a.early, o.early), both(a.phantom, o.phantom), both(a.miss, o.miss)});
    }
    const auto blocked = std::count_if(all.begin(), all.end(), blocksMore);
    const bool is_worse = 2 * static_cast<std::size_t>(blocked) > all.size();
    return std::string(
               "Does a map predict what the next scan sees? On recorded data AkiMap's "
               "default ") +
           (is_worse ? "is worse at it than OctoMap" : "is not worse at it than OctoMap") +
           ": of the rays of scans that neither got, it stops fewer within 1.5 cells of the return "
           "on " +
           countOf(all, isLessExact) + " recordings, fewer within 3.5 cells on " +
           countOf(all, isLessNear) + ", and more too early, in what is open, on " +
           countOf(all, blocksMore) + "; all three on " + countOf(all, losesAll) + ".\n\n" +
           table.text() + "\n";
}

/** One line for each scene; its entries follow each other. */
std::string lostFigures(const std::vector<std::pair<std::string, std::string>>& lost) {
    if (lost.empty()) return "Nowhere in these tables.\n";
    std::string text = "All figures in which AkiMap's default is not the best of a table:\n\n";
    for (std::size_t i = 0; i < lost.size(); i++) {
        const bool is_first = i == 0 || lost[i].first != lost[i - 1].first;
        const bool is_last = i + 1 == lost.size() || lost[i].first != lost[i + 1].first;
        text += (is_first ? "- " + lost[i].first + ": " : ", ") + lost[i].second +
                (is_last ? ".\n" : "");
    }
    return text;
}

}  // namespace

std::string openingOf(const Report& report) {
    return "\n## Where AkiMap is not the best\n\n" +
           (report.real.empty() ? "" : againstOctoMap(report.real)) + lostFigures(report.lost) +
           "\n## What was chosen on which data\n\n"
           "- The default estimator's constants: scans 5, 10, ... held out of rgbd_office at 5 and "
           "10 cm and of lidar_dense at 5 cm, and one simulated structured room with clean ranges. "
           "The corridor, LA3DM and rgbd_office at 2 cm were looked at meanwhile. What speaks "
           "for them: the simulated sensors and the other simulated rooms, which played no part; "
           "lidar_dense at 10 cm and 30 m and the other folds, which are of the same recordings. "
           "No real recording was kept aside.\n"
           "- The simulated sensors' errors: lidar_dense tuned the Ouster presets; rgbd_office was "
           "what the Kinect preset was checked against. No map's constant was chosen on a "
           "simulated "
           "scene with a sensor's errors.\n"
           "- The rivals: OctoMap, COctoMap and COccupancyGridMap3D have their libraries' "
           "defaults; the others' parameters are in their rows.\n";
}

}  // namespace akimap::bench
