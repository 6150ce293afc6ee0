// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
// The benchmark report: its tables say what was measured, and its protocols hold.

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "report/accuracy.h"
#include "report/equal_time.h"
#include "report/figures.h"
#include "report/markdown.h"
#include "report/sheet.h"

using namespace akimap;
using namespace akimap::bench;

namespace {

/** A wall at x = 2 seen from the origin, and 10 m away another. */
std::vector<Ray> wall(int rays) {
    std::vector<Ray> scan;
    for (int i = 0; i < rays; i++)
        scan.push_back({{0, 0, 0}, {i % 10 == 9 ? 10.0 : 2.0, 0.001 * i, 0.02}});
    return scan;
}

app::Evaluation evaluation(double auc, double mse) {
    app::Evaluation e{};
    e.known.auc = auc, e.known.mse = mse;
    return e;
}

TEST(Report, TablesAreAlignedAndFiguresRounded) {
    MarkdownTable table({"method", "σ"});
    table.add({"a", fixed(0.12345, 3)});
    table.add({"bc", fixed(NAN, 3)});
    EXPECT_EQ(table.text(),
              "| method |     σ |\n"
              "|:-------|------:|\n"
              "| a      | 0.123 |\n"
              "| bc     |     – |\n");
}

TEST(Report, RowsHaveTheMeanAndTheLargestDeviation) {
    const Row row = summarize("m", accuracyColumns(), {evaluation(0.8, 0.1), evaluation(0.9, 0.1)});
    EXPECT_NEAR(row.means[0], 0.85, 1e-12);
    EXPECT_NEAR(row.means[1], 0.1, 1e-12);
    EXPECT_NEAR(row.largest_deviation, 0.1 / std::sqrt(2), 1e-12);
    EXPECT_TRUE(
        std::isnan(summarize("m", accuracyColumns(), {evaluation(1, 0)}).largest_deviation));
}

TEST(Report, TellsWhereTheFirstRowIsNotTheBest) {
    const auto& columns = accuracyColumns();
    const std::vector<Row> rows = {summarize("ours", columns, {evaluation(0.9, 0.2)}),
                                   summarize("theirs", columns, {evaluation(0.8, 0.1)})};
    std::vector<std::pair<std::string, std::string>> lost;
    const std::string table = tableOf(rows, columns, {}, "a room", lost);
    EXPECT_NE(table.find("**0.900**"), std::string::npos);  // the higher AUC
    EXPECT_NE(table.find("**0.100**"), std::string::npos);  // the lower MSE
    EXPECT_EQ(table.find("**0.800**"), std::string::npos);
    ASSERT_EQ(lost.size(), 1u);
    EXPECT_EQ(lost[0].first, "a room");
    EXPECT_EQ(lost[0].second, "known MSE 0.200 (theirs: 0.100)");
}

TEST(Report, ThinnedScansAreNestedAndInRange) {
    const std::vector<std::vector<Ray>> scans = {wall(1000), wall(200)};
    std::set<double> before;
    for (const double share : {0.25, 0.5, 1.0}) {
        const auto thinned = thin(scans, share, kMaxRange);
        ASSERT_EQ(thinned.size(), 2u);
        std::set<double> kept;
        for (const Ray& r : thinned[0].rays) {
            EXPECT_LT(r.end[0], kMaxRange);
            kept.insert(r.end[1]);
        }
        EXPECT_NEAR(static_cast<double>(kept.size()), 900 * share, 45);
        for (const double y : before) EXPECT_TRUE(kept.count(y));
        EXPECT_EQ(thinned[0].cloud.observation.pointcloud->size(), thinned[0].rays.size());
        before = kept;
    }
    EXPECT_EQ(before.size(), 900u);
}

/** A method that is silent or wrong would make a table of nonsense. */
TEST(Report, EveryMethodMapsAWall) {
    std::vector<Ray> scan;
    for (int i = 0; i < 3600; i++)
        scan.push_back({{0.02, 0.02, 0.02}, {2.02, 0.02 * (i % 60) - 0.6, 0.02 * (i / 60) - 0.6}});
    Scene scene{"wall", {scan, scan, scan}, {}, {}};
    std::vector<Method> methods = akimapMethods();
    for (Method& m : otherMethods()) methods.push_back(std::move(m));
    ASSERT_GE(methods.size(), 8u);
    for (const Method& m : methods) {
        SCOPED_TRACE(m.name);
        const auto built = build(m, settingsFor(scene, 1), prepare(scene.scans, kMaxRange));
        const auto on = built.map->occupancy(2.02, 0.02, 0.02);
        const auto before = built.map->occupancy(1.0, 0.02, 0.02);
        ASSERT_TRUE(on && before);
        EXPECT_GT(*on, 0.5);
        EXPECT_LT(*before, 0.5);
        EXPECT_FALSE(built.map->occupancy(-3, 0, 0));
    }
}

/** Free space of known truth along x, as the wall's rays see it. */
app::Truth truthBefore() {
    app::Truth truth;
    truth.resolution = 0.05;
    for (int32_t x = 2; x < 30; x++) truth.leaves.push_back({{x, 0, 0}, 1, false});
    truth.leaves.push_back({{40, 0, 0}, 1, true});
    return truth;
}

TEST(Report, EachRecordingIsARunUnlessTheMethodIsSlow) {
    std::vector<Scene> scenes(3, Scene{"wall", {wall(300)}, truthBefore(), {}});
    Method method = otherMethods().front();
    ASSERT_FALSE(method.random);
    EXPECT_EQ(judgeMethod(method, prepareAll({scenes[0]}), 10).row.runs, 1u);
    scenes[1].scans = {};  // sees nothing: its row must differ
    const Row row = judgeMethod(method, prepareAll(scenes), 10).row;
    EXPECT_EQ(row.runs, 3u);
    EXPECT_GT(row.largest_deviation, 0.1);
    method.most_runs = 2;
    EXPECT_EQ(judgeMethod(method, prepareAll(scenes), 10).row.runs, 2u);
    method.random = true;
    EXPECT_EQ(judgeMethod(method, prepareAll({scenes[0]}), 10).row.runs, 2u);
}

/** A truth seen from other places, or of another room, would be missed by most returns. */
TEST(Report, TheRingsLieOnTheirTruth) {
    const Scene scene = simulatedRings(1, 0.1);
    const TruthCells cells(scene);
    const auto truth = cells.lookup();
    std::size_t returns = 0, on_surface = 0;
    for (const auto& scan : scene.scans)
        for (std::size_t i = 0; i < scan.size(); i += 50) {
            const Ray& r = scan[i];
            const double length =
                std::hypot(r.end[0] - r.origin[0], r.end[1] - r.origin[1], r.end[2] - r.origin[2]);
            returns++;
            for (const double step : {-0.06, -0.03, 0.0, 0.03, 0.06}) {  // the noise is 0.02 m
                const double s = 1 + step / length;
                const auto at = [&](std::size_t a) {
                    return r.origin[a] + s * (r.end[a] - r.origin[a]);
                };
                if (truth(at(0), at(1), at(2)).value_or(0) < 0.5) continue;
                on_surface++;
                break;
            }
        }
    EXPECT_GT(returns, 3000u);
    EXPECT_GT(static_cast<double>(on_surface), 0.99 * static_cast<double>(returns));
    EXPECT_NE(scene.scans[0][0].end, simulatedRings(2, 0.1).scans[0][0].end);
}

}  // namespace
