// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
//
// `akimap holdout`: maps judged by the scans they never got.

#include <akimap/rays.h>
#include <mrpt/obs/CObservation2DRangeScan.h>

#include "build_fixture.h"
#include "evaluation/holdout.h"
#include "evaluation/octomap_scan.h"

namespace {

using namespace build_tests;
using namespace akimap::app;
using akimap::InsertionParameters;
using akimap::Ray;

// The queries ------------------------------------------------------------------------------

/** How far from the origin a ray of that length asks for free places. */
std::vector<double> freeDistances(double length) {
    const Ray ray{{1, -2, 0.5}, {1 + 0.6 * length, -2, 0.5 - 0.8 * length}};
    std::vector<double> distances;
    for (const Query& q : queriesOf(ray)) {
        const double x = q.place[0] - 1, z = q.place[2] - 0.5, d = std::hypot(x, z);
        EXPECT_EQ(q.place[1], -2);
        EXPECT_NEAR(x, 0.6 * d, 1e-12) << "not on the ray";
        EXPECT_EQ(q.occupied, q.place == ray.end);
        if (!q.occupied) distances.push_back(d);
    }
    EXPECT_EQ(queriesOf(ray).back().place, ray.end);
    return distances;
}

TEST(Queries, OfOneRay) {
    const auto expectAt = [](double length, const std::vector<double>& expected) {
        const auto found = freeDistances(length);
        ASSERT_EQ(found.size(), expected.size()) << length;
        for (std::size_t i = 0; i < found.size(); i++) EXPECT_NEAR(found[i], expected[i], 1e-12);
    };
    expectAt(0.1, {});
    expectAt(0.65, {});
    expectAt(0.7, {0.5});
    expectAt(1.69, {0.5, 1});
    expectAt(1.7, {0.5, 1, 1.5});
    expectAt(2, {0.5, 1, 1.5});
}

TEST(Queries, KnownWhereTheMapHasEvidenceAndAHalfElsewhere) {
    const OccupancyLookup lookup = [](double x, double, double) -> std::optional<double> {
        return x < 0.7 ? std::optional(0.25) : x > 1.9 ? std::optional(0.75) : std::nullopt;
    };
    const ScoredCells cells = collect(lookup, {Ray{{0, 0, 0}, {2, 0, 0}}});
    ASSERT_EQ(cells.known.size(), 2u);
    EXPECT_EQ(cells.known[0].occupancy, 0.25);
    EXPECT_FALSE(cells.known[0].occupied);
    EXPECT_EQ(cells.known[1].occupancy, 0.75);
    EXPECT_TRUE(cells.known[1].occupied);
    ASSERT_EQ(cells.all.size(), 4u);
    EXPECT_EQ(cells.all[1].occupancy, 0.5);
    const Evaluation e = score(cells);
    EXPECT_NEAR(e.known.mse, 0.0625, 1e-12);
    EXPECT_NEAR(e.known.log_loss, -std::log(0.75), 1e-12);
    EXPECT_NEAR(e.all.mse, (2 * 0.0625 + 2 * 0.25) / 4, 1e-12);
    EXPECT_EQ(e.coverage, 0.5);
}

TEST(Queries, APerfectMapHasAnAucOfOneAndItsOppositeOfZero) {
    std::vector<Ray> rays;  // to a wall at x = 3
    for (int i = -10; i <= 10; i++) rays.push_back({{0, 0, 1}, {3, 0.2 * i, 1}});
    const auto wallIs = [&](double wall, double elsewhere) {
        return score(collect(
            [=](double x, double, double) { return std::optional(x > 2.99 ? wall : elsewhere); },
            rays));
    };
    EXPECT_EQ(wallIs(1, 0).known.auc, 1);
    EXPECT_EQ(wallIs(1, 0).known.mse, 0);
    EXPECT_NEAR(wallIs(1, 0).known.log_loss, -std::log(0.99), 1e-12);
    EXPECT_EQ(wallIs(0, 1).all.auc, 0);
}

TEST(Queries, OnlyOfTheGivenScansAndWithinTheRanges) {
    InsertionParameters ranges;
    ranges.min_range = 1, ranges.max_range = 4;
    const double nan = std::nan("");
    const auto to = [](double x) { return Ray{{0, 0, 0}, {x, 0, 0}}; };
    const std::vector<std::vector<Ray>> scans = {
        {to(2)}, {to(0.9), to(1), to(4), to(4.1), to(0), to(nan)}, {to(3)}, {}};
    const OccupancyLookup lookup = [](double x, double, double) { return std::optional(x / 5); };
    const ScoredCells cells = collect(lookup, scans, {1, 3}, ranges);
    ASSERT_EQ(cells.all.size(), 2u + 8u);  // the rays of 1 m and 4 m
    EXPECT_EQ(cells.all[1].occupancy, 0.2);
    EXPECT_EQ(cells.all.back().occupancy, 0.8);
    EXPECT_THROW(static_cast<void>(collect(lookup, scans, {3}, ranges)), std::runtime_error);
}

TEST(OctomapScan, EachRayOfAMovingSensorBeginsAtItsOwnOrigin) {
    const std::vector<Ray> rays = {
        {{0, 0, 1}, {2, 0, 1}}, {{0, 0, 1}, {2, 1, 1}}, {{0, 3, 1}, {2, 3, 1}}};
    mrpt::maps::COctoMap map(0.1);
    insertRays(map, rays);
    const auto occupancy = lookupIn(map);
    EXPECT_GT(occupancy(2.05, 0.05, 1.05).value_or(0), 0.5);
    EXPECT_GT(occupancy(2.05, 3.05, 1.05).value_or(0), 0.5);
    EXPECT_LT(occupancy(1.05, 3.05, 1.05).value_or(1), 0.5) << "on the way from its own origin";
    EXPECT_FALSE(occupancy(1.05, 1.55, 1.05)) << "on the way from the first ray's";
}

// The command -------------------------------------------------------------------------------

class Holdout : public Build {
 protected:
    ::Run holdout(const std::string& arguments) const {
        return runProgram("holdout " + arguments + " --json " + file("m.json"));
    }
    /** The figures of a run that must succeed. */
    nlohmann::json figuresOf(const std::string& arguments) const {
        const auto run = holdout(arguments);
        EXPECT_EQ(run.exit, 0) << run.err;
        return run.exit == 0 ? json() : nlohmann::json();
    }
};

void expectFigures(const nlohmann::json& json, const Evaluation& e) {
    EXPECT_GT(e.known.cells, 100u);
    EXPECT_EQ(json["known_cells"], e.known.cells);
    EXPECT_EQ(json["all_cells"], e.all.cells);
    for (const auto& [name, scores] : {std::pair("known_", e.known), std::pair("all_", e.all)}) {
        EXPECT_NEAR(json[name + std::string("auc")], scores.auc, 1e-9);
        EXPECT_NEAR(json[name + std::string("mse")], scores.mse, 1e-9);
        EXPECT_NEAR(json[name + std::string("log_loss")], scores.log_loss, 1e-9);
        EXPECT_NEAR(json[name + std::string("calibration_error")], scores.calibration_error, 1e-9);
    }
}

TEST_F(Holdout, IsWhatItsPartsSayByHand) {
    // At this resolution no place that is asked for lies on the border of a cell.
    AkiMap map(0.107), isotropic(0.107);
    isotropic.insertionOptions.estimator = akimap::Estimator::paper;
    isotropic.insertionOptions.bandwidth = akimap::Bandwidth::isotropic;
    mrpt::maps::COctoMap octomap(0.107);
    std::vector<Ray> held_out;
    for (int i = 0; i < kScans; i++) {
        if (i == 1 || i == 3) {  // scans 2 and 4
            const auto scan = wall(i);
            const auto& cloud = *scan->pointcloud;
            const CPose3D sensor = poseOf(i) + scan->sensorPose;
            for (std::size_t k = 0; k < cloud.size(); k++) {
                mrpt::math::TPoint3D p;
                cloud.getPoint(k, p.x, p.y, p.z);
                p = sensor.composePoint(p);
                held_out.push_back({{sensor.x(), sensor.y(), sensor.z()}, {p.x, p.y, p.z}});
            }
            continue;
        }
        auto at_origin = *wall(i);  // COctoMap ignores the sensor's pose on the robot
        const CPose3D sensor = poseOf(i) + at_origin.sensorPose;
        at_origin.sensorPose = CPose3D();
        map.insertObservation(*wall(i), poseOf(i));
        isotropic.insertObservation(*wall(i), poseOf(i));
        octomap.insertObservation(at_origin, sensor);
    }
    const auto json = figuresOf(plain("l.rawlog", walls()) + " --trajectory " + trajectory() +
                                " --every 2 --resolution 0.107");
    EXPECT_EQ(json["scans"], kScans);
    EXPECT_EQ(json["scans_held_out"], 2);
    EXPECT_EQ(json["queries"], 2 * 17 * 17 * 4);
    expectFigures(json["AkiMap"], score(collect(lookupIn(map), held_out)));
    expectFigures(json["isotropic"], score(collect(lookupIn(isotropic), held_out)));
    expectFigures(json["COctoMap"], score(collect(lookupIn(octomap), held_out)));
}

TEST_F(Holdout, BeamsWithoutAReturnAreTakenAsTheIniSays) {
    // An arc of 2 m about the robot; to its right, all but the held-out scan got no return.
    const auto arc = [](int i, bool whole) {
        auto scan = atTimeOf<CObservation2DRangeScan>(i);
        scan->aperture = 3, scan->maxRange = 6;
        scan->sensorPose = CPose3D(0, 0, 1, 0, 0, 0);
        scan->resizeScanAndAssign(91, 2, true);
        for (std::size_t k = 0; k < 45; k++) scan->setScanRangeValidity(k, whole);
        return scan;
    };
    const auto held_out = akimap::raysOf(*arc(1, true), [](auto) { return CPose3D(); }).value();
    ASSERT_EQ(held_out.size(), 91u);
    Objects scans;
    for (int i = 0; i < 3; i++) scans.push_back(arc(i, i == 1));
    std::string standing;
    for (int i = 0; i < 3; i++) standing += std::to_string(timeOf(i)) + " 0 0 0 0 0 0 1\n";
    const std::string log =
        plain("l.rawlog", scans) + " --trajectory " + write("t.tum", standing) + " --every 2 -c ";

    AkiMap map(0.107);
    map.insertionOptions.beyond_max_range = akimap::BeyondMaxRange::free;
    AkiMap isotropic = map;
    isotropic.insertionOptions.estimator = akimap::Estimator::paper;
    isotropic.insertionOptions.bandwidth = akimap::Bandwidth::isotropic;
    mrpt::maps::COctoMap octomap(0.107);
    for (const int i : {0, 2}) {
        map.insertObservation(*arc(i, false));
        isotropic.insertObservation(*arc(i, false));
        insertRays(octomap, akimap::raysOf(*arc(i, false), [](auto) { return CPose3D(); }).value());
    }
    const std::string ini =
        "[MappingApplication]\nakimap_count = 1\n[MappingApplication_akimap_00_creationOpts]\n"
        "resolution = 0.107\n[MappingApplication_akimap_00_insertOpts]\nbeyond_max_range = ";
    const auto ignored = figuresOf(log + write("ignore.ini", ini + "ignore\n"));
    const auto json = figuresOf(log + write("free.ini", ini + "free\n"));
    EXPECT_EQ(json["queries"], 91 * 4) << "beams without a return are no queries";
    EXPECT_GT(json["AkiMap"]["known_cells"], ignored["AkiMap"]["known_cells"]);
    expectFigures(json["AkiMap"], score(collect(lookupIn(map), held_out)));
    expectFigures(json["isotropic"], score(collect(lookupIn(isotropic), held_out)));
    expectFigures(json["COctoMap"], score(collect(lookupIn(octomap), held_out)));
}

TEST_F(Holdout, BeamsWithoutAReturnAreNoQueries) {
    // Held out now is the scan that lacks some.
    auto scan = atTimeOf<CObservation2DRangeScan>(0);
    scan->aperture = 3, scan->maxRange = 6;
    scan->resizeScanAndAssign(91, 2, true);
    auto lacking = CObservation2DRangeScan::Create(*scan);
    lacking->timestamp = mrpt::Clock::fromDouble(timeOf(1));
    for (std::size_t k = 0; k < 45; k++) lacking->setScanRangeValidity(k, false);
    const std::string log =
        plain("l.rawlog", {scan, lacking}) + " --trajectory " + trajectory(0, 1);
    const auto json =
        figuresOf(log + " --every 2 -c " +
                  write("free.ini",
                        "[MappingApplication]\nakimap_count = 1\n"
                        "[MappingApplication_akimap_00_insertOpts]\nbeyond_max_range = free\n"));
    EXPECT_EQ(json["queries"], 46 * 4);
}

TEST_F(Holdout, NoMapGetsAHeldOutScan) {
    const std::string seen = write("seen.pcd", asciiPcd("2 0 1\n2 .1 1\n", 2)) + " ";
    const std::string alone = write("alone.pcd", asciiPcd("-2 0 1\n-2 .1 1\n", 2)) + " ";
    // The place in cloud 5 is in no other: all that is known of its rays is what lies around the
    // sensor, nothing 0.5 m from it or more.
    const auto unseen = figuresOf(seen + seen + seen + seen + alone + seen);
    EXPECT_EQ(unseen["scans_held_out"], 1);
    EXPECT_EQ(unseen["queries"], 8);
    for (const char* map : {"AkiMap", "isotropic", "COctoMap"})
        EXPECT_EQ(unseen[map]["known_cells"], 0) << map;
    EXPECT_TRUE(unseen["AkiMap"]["known_auc"].is_null());
    const auto known = figuresOf(seen + seen + seen + alone + seen + seen);
    for (const char* map : {"AkiMap", "isotropic", "COctoMap"})
        EXPECT_GE(known[map]["known_cells"], 2) << map << ": at least the ends";
}

TEST_F(Holdout, ATableOfAllThreeMaps) {
    const auto run =
        runProgram("holdout " + plain("l.rawlog", walls()) + " --trajectory " + trajectory());
    EXPECT_EQ(run.exit, 0) << run.err;
    EXPECT_EQ(run.err, "");
    for (const char* part : {"5 scans, 1 of them held out", "AkiMap", "isotropic", "COctoMap",
                             "known queries", "all queries", "log loss", "calibration error"})
        EXPECT_TRUE(holds(run.out, part)) << run.out << "lacks " << part;
}

TEST_F(Holdout, PlotsNameAllThreeMaps) {
    figuresOf(plain("l.rawlog", walls()) + " --trajectory " + trajectory() + " --roc " +
              file("roc.svg") + " --calibration " + file("reliability.svg"));
    for (const char* plot : {"roc.svg", "reliability.svg"})
        for (const char* map : {"AkiMap", "isotropic", "COctoMap"})
            EXPECT_TRUE(holds(readText(file(plot)), map)) << plot << " lacks " << map;
}

TEST_F(Holdout, AMovingVelodyneHasAPoseForEachPacket) {
    const auto simulated =
        runProgram("simulate structured --sensor velodyne --moving -o " + folder.path().string());
    ASSERT_EQ(simulated.exit, 0) << simulated.err;
    // The simplemap holds the same scans with one pose each.
    const auto ignored = figuresOf(file("scene.simplemap") + " --every 4");
    const auto heeded =
        figuresOf(file("scene.rawlog") + " --trajectory " + file("trajectory.tum") + " --every 4");
    for (const char* map : {"AkiMap", "isotropic", "COctoMap"})
        EXPECT_GT(heeded[map]["known_auc"].get<double>(),
                  ignored[map]["known_auc"].get<double>() + 0.05)
            << map;
}

TEST_F(Holdout, Refusals) {
    const auto refused = [&](const std::string& arguments, const std::string& part) {
        const auto run = holdout(arguments);
        EXPECT_NE(run.exit, 0) << arguments;
        EXPECT_TRUE(holds(run.err, part)) << run.err << "lacks " << part;
        EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
        EXPECT_FALSE(std::filesystem::exists(file("m.json"))) << arguments;
    };
    const std::string pcd = write("p.pcd", asciiPcd("2 0 1\n", 1)) + " ";
    const std::string far = write("f.pcd", asciiPcd("90 0 1\n", 1)) + " ";
    refused(pcd + "--every 1", "--every must be at least 2");
    refused(pcd + "--every 0", "--every must be at least 2");
    refused(pcd + "--every x", "--every");
    refused(pcd + pcd + pcd + pcd, "4 scans in the inputs: with --every 5 none is held out");
    refused(pcd + pcd + "--first 1 --every 2", "1 scans in the inputs");
    refused(pcd + far + "--every 2", "no point within range");
    refused(far + pcd + "--every 2", "nothing usable");
    refused(file("none.pcd"), "none.pcd: no such file");
    refused(pcd + pcd + "--resolution -1", "resolution = ");
    refused(pcd + "--follow", "--follow");
    refused(pcd + "--roc " + file("roc.txt"), "roc.txt");
    refused(pcd + "--roc " + file("a.png") + " --calibration " + file("a.png"), "twice");
    const auto full = runProgram("holdout " + pcd + pcd + "--every 2 --json /dev/full");
    EXPECT_EQ(full.exit, 1);
    EXPECT_TRUE(holds(full.err, "/dev/full")) << full.err;
    const auto run = runProgram("holdout " + pcd + "--json " + pcd);
    EXPECT_EQ(run.exit, 1);
    EXPECT_TRUE(holds(run.err, "this output is an input too")) << run.err;
}

TEST_F(Holdout, TheCorridor) {
    const char* data = std::getenv("AKIMAP_DATA");
    if (!data || !std::filesystem::exists(std::string(data) + "/corridor"))
        GTEST_SKIP() << "no corridor/ in AKIMAP_DATA";
    std::string clouds;
    for (int i = 1; i <= 16; i++)
        clouds += "'" + std::string(data) + "/corridor/corridor_" + std::to_string(i) + ".pcd' ";
    const auto json = figuresOf(clouds);
    EXPECT_EQ(json["scans_held_out"], 3);
    const auto ours = json["AkiMap"], theirs = json["COctoMap"];
    EXPECT_GT(ours["known_auc"], theirs["known_auc"]);
    EXPECT_LT(ours["known_mse"], theirs["known_mse"]);
    EXPECT_LT(ours["known_log_loss"], theirs["known_log_loss"]);
    // Nothing is asked of AkiMap beside its isotropic mode, which is the better one here.
}

}  // namespace
