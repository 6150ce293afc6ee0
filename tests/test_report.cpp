// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
// The benchmark report: its tables say what was measured, and its protocols hold.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "report/accuracy.h"
#include "report/contents.h"
#include "report/figures.h"
#include "report/markdown.h"
#include "report/noisy.h"
#include "report/sheet.h"
#include "run_program.h"

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

TEST(Report, AYardstickIsNeverTheBest) {
    std::vector<std::pair<std::string, std::string>> lost;
    const std::vector<std::string> names{"ours", "theirs", "yardstick"};
    EXPECT_EQ(cellsOf({"near3", Better::higher, {0.8, 0.9, 1.0}}, names, 2, "a room", lost),
              (std::vector<std::string>{"0.800", "**0.900**", "1.000"}));
    ASSERT_EQ(lost.size(), 1u);
    EXPECT_EQ(lost[0].second, "near3 0.800 (theirs: 0.900)");
    EXPECT_EQ(cellsOf({"mm", Better::lower, {NAN, 4.23, 1}, 1}, names, 2, "a room", lost)[1],
              "**4.2**");
    lost.clear();
    EXPECT_EQ(cellsOf({"tie", Better::lower, {0.1004, 0.1, 0}}, names, 2, "a room", lost)[0],
              "**0.100**");
    EXPECT_EQ(cellsOf({"ms", Better::neither, {2, 1, 0}, 0}, names, 2, "a room", lost)[1], "1");
    EXPECT_TRUE(lost.empty());
}

TEST(Report, OpensWithWhatIsLost) {
    Report report;
    report.real = {{"office", {.6, .8, .2, .01, .02}, {.7, .9, .1, .01, .02}},
                   {"street", {.8, .9, .2, .01, .02}, {.7, .8, .1, .01, .02}}};
    report.lost = {{"office", "near3 0.800 (OctoMap: 0.900)"}, {"office", "early"}, {"b", "c"}};
    const std::string text = openingOf(report);
    EXPECT_NE(text.find("1.5 cells of the return on 1 of the 2 recordings, fewer within 3.5 cells "
                        "on 1 of the 2, and more too early, in what is open, on 2 of the 2; all "
                        "three on 1 of the 2."),
              std::string::npos)
        << text;
    EXPECT_NE(text.find("0.600 / 0.700"), std::string::npos);
    EXPECT_NE(text.find("is worse at it than OctoMap"), std::string::npos);
    std::swap(report.real[0].akimap, report.real[0].octomap);
    EXPECT_EQ(openingOf(report).find("is worse"), std::string::npos) << "it is not, on half";
    EXPECT_NE(text.find("- office: near3 0.800 (OctoMap: 0.900), early.\n- b: c.\n"),
              std::string::npos);
}

TEST(Report, JudgesTheRealRecordingsFirst) {
    std::vector<std::string> names;
    for (const Trial& t : realTrials()) names.push_back(t.name);
    EXPECT_EQ(names, (std::vector<std::string>{
                         "RGB-D office, 2 cm cells", "RGB-D office, 5 cm cells",
                         "RGB-D office, 10 cm cells", "Dense lidar, 5 cm cells, 10 m",
                         "Dense lidar, 10 cm cells, 30 m", "Corridor, 5 cm cells",
                         "LA3DM long-term, sensor raised", "LA3DM structured, sensor raised"}));
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

/** Of a corner of three walls, 2 m away, from five places. */
std::vector<PosedScan> corner() {
    std::vector<PosedScan> scans;
    for (int n = 0; n < 5; n++) {
        const double x = 0.03 * n;
        PosedScan scan{mrpt::poses::CPose3D(x, 0, 0, 0.1 * n, 0, 0), {}};
        for (double u = -0.98; u < 2; u += 0.037)
            for (double v = -0.98; v < 2; v += 0.041)
                for (const std::array<double, 3>& p :
                     {std::array{2.01, u, v}, {u, 2.01, v}, {u, v, 2.01}})
                    scan.rays.push_back({{x, 0, 0}, p});
        scans.push_back(std::move(scan));
    }
    return scans;
}

TEST(Report, FindsASensorBeforeACorner) {
    LocalizationRules rules;
    rules.starts = 3;
    const auto estimates =
        localize({"corner", corner(), 0.05, 8}, rules, [](const std::string&) {});
    ASSERT_EQ(estimates.size(), 6u);
    for (const PoseEstimates& e : estimates) {
        SCOPED_TRACE(e.map + " " + e.method);
        const bool has_none = e.map == "COctoMap" && e.method == "ICP";
        EXPECT_EQ(e.metres.size(), has_none ? 0u : 3u);
        const bool must_find_it = (e.map == "AkiMap" || e.method == "ICP") && !has_none;
        EXPECT_TRUE(!must_find_it || e.good() == 1.);
    }
}

/** All sections on inputs of a moment: each has its rows, and the world comes first. */
TEST(Report, HasItsSectionsInOrder) {
    const TemporaryFolder folder;
    Report report;
    report.pictures = folder.path().string(), report.pictures_link = "pictures", report.seeds = 1;
    report.doing = [](const std::string&) {};
    const app::Box box{{-0.5, -0.5, -0.5}, {3, 0.5, 1.5}};
    const Scene scene{"a wall", std::vector<std::vector<Ray>>(5, wall(300)), truthBefore(), box};
    Contents contents;
    Trial trial{"a recording", "recording", "Real.", 0.05, 8, true, true, {}};
    trial.scans = [=] { return scene.scans; };
    Trial absent = trial;
    absent.name = "absent", absent.scans = [] { return std::vector<std::vector<Ray>>(); };
    contents.real = {trial, absent};
    contents.noisy = {{"a sensor", [=] { return std::vector<Scene>{scene}; }}};
    contents.walks = {[&] {
        return WatchedWalk{"a walk", 0.05, 8, {{scene.scans[0], {{20, 0, 0}}}, {wall(9), {}}}, 1};
    }};
    contents.localization = [] {
        return std::vector<LocalizationCase>{{"a corner", corner(), 0.05, 8}};
    };
    contents.localization_rules.starts = 1;
    Place place{"clean", "clean", "Ideal.", 1, {}, [=](uint64_t) { return scene; }};
    contents.clean = {place};
    place.name = place.file = "shipped";
    contents.as_shipped = {place};
    const std::string text = bodyOf(report, contents);
    std::size_t at = 0;
    for (const char* part : {"\n## What the next scan sees",
                             "\n### a recording\n",
                             " near1 |",
                             "\n| AkiMap ",
                             "\n| paper ",
                             "\n| isotropic ",
                             "\n| OctoMap ",
                             "\n| TSDF ",
                             "\n| OctoMap+ ",
                             "AkiMap less OctoMap",
                             "known to all: AUC |",
                             "\n| OctoMap+ ",
                             "pictures/depth_recording.png",
                             "\n## Simulated scenes with the sensors' errors",
                             "\n### a sensor\n",
                             " known AUC |",
                             "\n| TSDF ",
                             " near1 |",
                             "\n## Things that move",
                             "\n### a walk",
                             "\n## Localization",
                             "\n### a corner",
                             "\n| AkiMap ",
                             "\n| CSimplePointsMap ",
                             "\n| COctoMap ",
                             "\n## Simulated scenes with clean ranges",
                             "\n### clean",
                             "\n| BGKOctoMap ",
                             "\n## LA3DM as shipped",
                             "Table II"}) {
        const std::size_t next = text.find(part, at);
        ASSERT_NE(next, std::string::npos) << part << " is not after\n" << text.substr(0, at);
        at = next;
    }
    EXPECT_EQ(text.find("absent"), std::string::npos);
    ASSERT_EQ(report.real.size(), 1u);
    EXPECT_EQ(report.real[0].recording, "a recording");
    EXPECT_TRUE(std::filesystem::exists(folder.file("depth_recording.png")));
}

}  // namespace
