// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
//
// Things that move: what is counted of them, exactly, in tiny cases; and the walk that is watched.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "report/moving.h"

namespace {

using namespace akimap;
using namespace akimap::bench;

const CellPlace kA{1, 0, 0}, kB{2, 0, 0}, kC{3, 0, 0};

/** Says of each cell after each scan what the test says. */
class ScriptedMap : public MapUnderTest {
 public:
    explicit ScriptedMap(std::map<CellPlace, std::string> script) : script_(std::move(script)) {}
    void insert(const PreparedScan&) override { scan_++; }
    std::optional<double> occupancy(double x, double y, double z) const override {
        const auto index = [](double v) { return static_cast<int>(std::floor(v / 0.1)); };
        const auto told = script_.find({index(x), index(y), index(z)});
        if (told == script_.end()) return std::nullopt;
        const char state = told->second[scan_ - 1];
        if (state == '?') return std::nullopt;
        return state == '#' ? 0.51 : 0.5;
    }

 private:
    std::map<CellPlace, std::string> script_;
    std::size_t scan_ = 0;
};

WatchedWalk walkOf(const std::vector<std::vector<CellPlace>>& someone) {
    WatchedWalk walk{"tiny", 0.1, 8, {}, 0};
    for (const auto& cells : someone) walk.scans.push_back({{}, cells});
    return walk;
}

TEST(Moving, ResidueAndWaitsAreCounted) {
    ScriptedMap map({{kA,
                      "###."
                      "...."},
                     {kB,
                      ".###"
                      "####"},
                     {kC,
                      "?..#"
                      "?..."}});
    // A is left in scan 2, B and C in scan 3; C was not occupied then.
    const Residue r = watch(map, walkOf({{kA}, {kA, kB}, {kB, kC}, {}, {}, {}, {}, {}}));
    EXPECT_EQ(r.cells, (std::vector<std::size_t>{0, 0, 1, 2, 1, 1, 1, 1}));
    EXPECT_EQ(r.present, (std::vector<std::size_t>{1, 2, 1, 0, 0, 0, 0, 0}));
    EXPECT_EQ(r.waits, (std::vector<std::size_t>{2}));  // A: occupied in scan 2, free in 3
    EXPECT_EQ(r.never, 1u);                             // B
}

TEST(Moving, WhatIsFreeAtOnceWaitsOneScan) {
    ScriptedMap map({{kA, "#.."}});
    const Residue r = watch(map, walkOf({{kA}, {}, {}}));
    EXPECT_EQ(r.cells, (std::vector<std::size_t>{0, 0, 0}));
    EXPECT_EQ(r.waits, (std::vector<std::size_t>{1}));
    EXPECT_EQ(r.never, 0u);
}

TEST(Moving, ACellEnteredAgainBeginsAgain) {
    ScriptedMap map({{kA, "#####."}});
    const Residue r = watch(map, walkOf({{kA}, {}, {kA}, {}, {}, {}}));
    EXPECT_EQ(r.cells, (std::vector<std::size_t>{0, 1, 0, 1, 1, 0}));
    EXPECT_EQ(r.waits, (std::vector<std::size_t>{3}));  // from scan 3 on
    EXPECT_EQ(r.never, 0u);
}

/** A ray along x through the cell at 1 m, up to x. */
std::vector<Ray> rayTo(double x) {
    return {{{0.05, 0.05, 0.05}, {x, 0.05, 0.05}}};
}

TEST(Moving, OctoMapForgetsAHitAfterThreeMisses) {
    // Log-odds of its defaults: 0.847 for a hit of 0.7, less 0.405 for each miss of 0.4.
    WatchedWalk walk = walkOf({{{10, 0, 0}}, {}, {}, {}, {}});
    walk.scans[0].rays = rayTo(1.05);
    for (std::size_t i = 1; i < 5; i++) walk.scans[i].rays = rayTo(2.05);
    MapSettings settings;
    settings.resolution = 0.1;
    const auto octomap = otherMethods().front().make(settings);
    const Residue r = watch(*octomap, walk);
    EXPECT_EQ(r.cells, (std::vector<std::size_t>{0, 1, 1, 0, 0}));
    EXPECT_EQ(r.waits, (std::vector<std::size_t>{3}));
}

TEST(Moving, TheWatchedWalkCrossesTheViewAndEnds) {
    const WatchedWalk walk = simulatedWalk(app::SensorKind::kinect, "kinect", 1, 0.1);
    EXPECT_TRUE(walk.scans.front().someone.empty());
    EXPECT_TRUE(walk.scans[walk.gone].someone.empty());
    EXPECT_FALSE(walk.scans[walk.gone - 1].someone.empty());
    EXPECT_GE(walk.scans.size(), walk.gone + 50);
    std::size_t most = 0;  // returns off someone, in a scan
    for (const WatchedScan& scan : walk.scans) {
        EXPECT_TRUE(std::is_sorted(scan.someone.begin(), scan.someone.end()));
        std::size_t hits = 0;
        for (const Ray& ray : scan.rays) {
            const auto index = [&](std::size_t i) {
                return static_cast<int>(std::floor(ray.end[i] / 0.1));
            };
            const CellPlace cell{index(0), index(1), index(2)};
            hits += std::binary_search(scan.someone.begin(), scan.someone.end(), cell);
        }
        most = std::max(most, hits);
    }
    EXPECT_GT(most, 500u);
}

TEST(Moving, TheTableHasARowForEachMap) {
    WatchedWalk walk = walkOf({{{10, 0, 0}}, {}, {}, {}, {}});
    walk.scans[0].rays = rayTo(1.05);
    for (std::size_t i = 1; i < 5; i++) walk.scans[i].rays = rayTo(2.05);
    walk.gone = 1;
    Report report;
    report.doing = [](const std::string&) {};
    const std::string table = movingSection(report, walk);
    EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 5) << table;
    const auto line = table.substr(table.find("| COctoMap"));
    std::string squeezed;
    std::copy_if(line.begin(), line.end(), std::back_inserter(squeezed),
                 [](char c) { return c != ' '; });
    EXPECT_EQ(squeezed, "|COctoMap|1|0|1|–|–|–|–|3|3|0of1|\n") << table;
}

}  // namespace
