// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
//
// `akimap holdout`: maps judged by the scans they never got.

#include <akimap/rays.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <octomap/OcTree.h>

#include "build_fixture.h"
#include "evaluation/holdout.h"

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

TEST(Queries, OfOneRayUpToOneCellAndAHalfBeforeItsEnd) {
    const auto expectAt = [](double length, const std::vector<double>& expected) {
        const Ray ray{{0, 1, 2}, {0, 1 + length, 2}};
        const auto found = closeQueriesOf(ray, 0.1);
        ASSERT_EQ(found.size(), expected.size() + 1) << length;
        for (std::size_t i = 0; i < expected.size(); i++) {
            EXPECT_NEAR(found[i].place[1], 1 + expected[i], 1e-12);
            EXPECT_FALSE(found[i].occupied);
        }
        EXPECT_EQ(found.back().place, ray.end);
        EXPECT_TRUE(found.back().occupied);
    };
    expectAt(0.1, {});
    expectAt(0.4, {0.25});
    expectAt(0.7, {0.5, 0.55});
    expectAt(1.69, {0.5, 1, 1.5, 1.54});
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

TEST(Queries, OnlyWithinTheRanges) {
    InsertionParameters ranges;
    ranges.min_range = 1, ranges.max_range = 4;
    const double nan = std::nan("");
    const auto to = [](double x) { return Ray{{0, 0, 0}, {x, 0, 0}}; };
    const auto kept = raysInRange({to(0.9), to(1), to(4), to(4.1), to(0), to(nan)}, ranges);
    ASSERT_EQ(kept.size(), 2u);
    EXPECT_EQ(kept[0].end[0], 1);
    EXPECT_EQ(kept[1].end[0], 4);
    EXPECT_THROW(static_cast<void>(collect([](double, double, double) { return 0.5; }, {})),
                 std::runtime_error);
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

constexpr const char* kMaps[] = {"AkiMap", "paper", "isotropic", "OctoMap", "TSDF"};

void expectFigures(const nlohmann::json& map, const Evaluation& e) {
    const auto& json = map["cells_to_0.2_m"];
    EXPECT_GT(e.known.cells, 100u);
    EXPECT_EQ(json["known"]["queries"], e.known.cells);
    EXPECT_EQ(json["all"]["queries"], e.all.cells);
    for (const auto& [name, scores] : {std::pair("known", e.known), std::pair("all", e.all)}) {
        EXPECT_NEAR(json[name]["auc"], scores.auc, 1e-6);
        EXPECT_NEAR(json[name]["brier"], scores.mse, 1e-6);
        EXPECT_NEAR(json[name]["log_loss"], scores.log_loss, 1e-6);
        EXPECT_NEAR(json[name]["calibration_error"], scores.calibration_error, 1e-6);
        EXPECT_NEAR(json[name]["f1_occupied"], scores.occupied.f1, 1e-6);
    }
}

TEST_F(Holdout, IsWhatItsPartsSayByHand) {
    // At this resolution no place that is asked for lies on the border of a cell.
    AkiMap map(0.107), paper(0.107), isotropic(0.107);
    paper.insertionOptions.estimator = isotropic.insertionOptions.estimator =
        akimap::Estimator::paper;
    isotropic.insertionOptions.bandwidth = akimap::Bandwidth::isotropic;
    octomap::OcTree octomap(0.107);
    std::vector<Ray> held_out;
    for (int i = 0; i < kScans; i++) {
        const auto scan = wall(i);
        const auto& cloud = *scan->pointcloud;
        const CPose3D sensor = poseOf(i) + scan->sensorPose;
        std::vector<Ray> rays;
        octomap::Pointcloud points;
        for (std::size_t k = 0; k < cloud.size(); k++) {
            mrpt::math::TPoint3D p;
            cloud.getPoint(k, p.x, p.y, p.z);
            p = sensor.composePoint(p);
            rays.push_back({{sensor.x(), sensor.y(), sensor.z()}, {p.x, p.y, p.z}});
            points.push_back(static_cast<float>(p.x), static_cast<float>(p.y),
                             static_cast<float>(p.z));
        }
        if (i == 1 || i == 3) {  // scans 2 and 4
            held_out.insert(held_out.end(), rays.begin(), rays.end());
            continue;
        }
        for (AkiMap* m : {&map, &paper, &isotropic}) m->insertObservation(*scan, poseOf(i));
        octomap.insertPointCloud(points,
                                 {static_cast<float>(sensor.x()), static_cast<float>(sensor.y()),
                                  static_cast<float>(sensor.z())},
                                 -1, false, true);
    }
    const auto json = figuresOf(plain("l.rawlog", walls()) + " --trajectory " + trajectory() +
                                " --every 2 --resolution 0.107");
    EXPECT_EQ(json["scans"], kScans);
    EXPECT_EQ(json["scans_held_out"], 2);
    EXPECT_EQ(json["rays"], 2 * 17 * 17);
    expectFigures(json["maps"]["AkiMap"], score(collect(lookupIn(map), held_out)));
    expectFigures(json["maps"]["paper"], score(collect(lookupIn(paper), held_out)));
    expectFigures(json["maps"]["isotropic"], score(collect(lookupIn(isotropic), held_out)));
    expectFigures(json["maps"]["OctoMap"], score(collect(lookupIn(octomap), held_out)));
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
    for (const int i : {0, 2}) {
        map.insertObservation(*arc(i, false));
        isotropic.insertObservation(*arc(i, false));
    }
    const std::string ini =
        "[MappingApplication]\nakimap_count = 1\n[MappingApplication_akimap_00_creationOpts]\n"
        "resolution = 0.107\n[MappingApplication_akimap_00_insertOpts]\nbeyond_max_range = ";
    const auto ignored = figuresOf(log + write("ignore.ini", ini + "ignore\n"))["maps"];
    const auto json = figuresOf(log + write("free.ini", ini + "free\n"));
    EXPECT_EQ(json["rays"], 91) << "beams without a return are no rays to judge by";
    const auto known = [](const nlohmann::json& maps, const char* name) {
        return maps[name]["cells_to_0.2_m"]["known"]["queries"].get<int>();
    };
    EXPECT_GT(known(json["maps"], "AkiMap"), known(ignored, "AkiMap"));
    for (const char* rival : {"OctoMap", "TSDF"})
        EXPECT_EQ(known(json["maps"], rival), known(ignored, rival)) << "they get the returns only";
    expectFigures(json["maps"]["AkiMap"], score(collect(lookupIn(map), held_out)));
    expectFigures(json["maps"]["isotropic"], score(collect(lookupIn(isotropic), held_out)));
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
    EXPECT_EQ(json["rays"], 46);
}

TEST_F(Holdout, NoMapGetsAHeldOutScanButTheYardstick) {
    const std::string seen = write("seen.pcd", asciiPcd("2 0 1\n2 .1 1\n", 2)) + " ";
    const std::string alone = write("alone.pcd", asciiPcd("-2 0 1\n-2 .1 1\n", 2)) + " ";
    // The place in cloud 5 is in no other: all that is known of its rays is what lies around the
    // sensor, nothing 0.5 m from it or more.
    const auto unseen = figuresOf(seen + seen + seen + seen + alone + seen);
    EXPECT_EQ(unseen["scans_held_out"], 1);
    EXPECT_EQ(unseen["rays"], 2);
    const auto knownTo = [](const nlohmann::json& json, const std::string& map) {
        return json["maps"][map]["cells_to_0.2_m"]["known"]["queries"].get<int>();
    };
    for (const char* map : kMaps) {
        EXPECT_EQ(knownTo(unseen, map), 0) << map;
        EXPECT_EQ(unseen["maps"][map]["rays"]["unknown"], 1) << map;
    }
    EXPECT_EQ(knownTo(unseen, "OctoMap+"), 8);
    EXPECT_TRUE(unseen["maps"]["AkiMap"]["cells_to_0.2_m"]["known"]["auc"].is_null());
    const auto known = figuresOf(seen + seen + seen + alone + seen + seen);
    for (const char* map : kMaps) {
        EXPECT_GE(knownTo(known, map), 2) << map << ": at least the ends";
        EXPECT_EQ(known["maps"][map]["rays"]["near3"], 1) << map;
    }
}

TEST_F(Holdout, EachScanOnceInAllFolds) {
    const auto json = figuresOf(plain("l.rawlog", walls()) + " --trajectory " + trajectory() +
                                " --every 2 --folds all");
    EXPECT_EQ(json["scans_held_out"], kScans);
    EXPECT_EQ(json["rays"], kScans * 17 * 17);
    std::set<int> scans;
    for (const auto& scan : json["maps"]["TSDF"]["scans"]) scans.insert(scan["scan"].get<int>());
    EXPECT_EQ(scans, (std::set<int>{1, 2, 3, 4, 5}));
}

TEST_F(Holdout, ATableOfAllMaps) {
    const auto run =
        runProgram("holdout " + plain("l.rawlog", walls()) + " --trajectory " + trajectory());
    EXPECT_EQ(run.exit, 0) << run.err;
    EXPECT_EQ(run.err, "");
    for (const char* part : {"5 scans, 1 of them held out", "OctoMap+", "near1", "phantom",
                             "Difference from OctoMap", "Faithfulness", "1.5 cells before",
                             "0.2 m before", "log-loss", "calibration error", "to insert"})
        EXPECT_TRUE(holds(run.out, part)) << run.out << "lacks " << part;
    for (const char* map : kMaps) EXPECT_TRUE(holds(run.out, map)) << run.out << "lacks " << map;
}

TEST_F(Holdout, PlotsNameAllMaps) {
    figuresOf(plain("l.rawlog", walls()) + " --trajectory " + trajectory() + " --roc " +
              file("roc.svg") + " --calibration " + file("reliability.svg"));
    for (const char* plot : {"roc.svg", "reliability.svg"})
        for (const char* map : kMaps)
            EXPECT_TRUE(holds(readText(file(plot)), map)) << plot << " lacks " << map;
}

TEST_F(Holdout, APictureOfAHeldOutScan) {
    const std::string log = plain("l.rawlog", walls()) + " --trajectory " + trajectory();
    figuresOf(log + " --depth-picture " + file("a.png"));
    figuresOf(log + " --folds all --depth-scan 2 --depth-picture " + file("b.png"));
    for (const char* picture : {"a.png", "b.png"}) {
        mrpt::img::CImage image;
        ASSERT_TRUE(image.loadFromFile(file(picture)));
        EXPECT_GT(image.getWidth(), 1000u);
    }
    EXPECT_NE(readText(file("a.png")), readText(file("b.png")));
}

TEST_F(Holdout, AMovingVelodyneHasAPoseForEachPacket) {
    const auto simulated =
        runProgram("simulate structured --sensor velodyne --moving -o " + folder.path().string());
    ASSERT_EQ(simulated.exit, 0) << simulated.err;
    // The simplemap holds the same scans with one pose each.
    const auto ignored = figuresOf(file("scene.simplemap") + " --every 4");
    const auto heeded =
        figuresOf(file("scene.rawlog") + " --trajectory " + file("trajectory.tum") + " --every 4");
    const auto near3 = [](const nlohmann::json& json, const char* map) {
        return json["maps"][map]["rays"]["near3"].get<double>();
    };
    for (const char* map : kMaps) EXPECT_GT(near3(heeded, map), near3(ignored, map) + 0.05) << map;
}

TEST_F(Holdout, Refusals) {
    const auto refused = [&](const std::string& arguments, const std::string& part) {
        const auto run = holdout(arguments);
        EXPECT_NE(run.exit, 0) << arguments;
        EXPECT_TRUE(holds(run.err, part)) << run.err << "lacks " << part;
        // After a warning, maybe, of clouds from one place.
        const auto last = run.err.rfind('\n', run.err.size() - 2);
        const std::string before = run.err.substr(0, last == std::string::npos ? 0 : last + 1);
        EXPECT_TRUE(before.empty() || holds(before, "have the same VIEWPOINT")) << run.err;
        EXPECT_LE(std::count(before.begin(), before.end(), '\n'), 1) << run.err;
        if (std::filesystem::exists(file("m.json"))) {
            EXPECT_EQ(json().size(), 1u) << arguments << ": nothing but the error";
            EXPECT_TRUE(holds(run.err, json()["error"])) << json() << run.err;
        }
        std::filesystem::remove(file("m.json"));
    };
    const std::string pcd = write("p.pcd", asciiPcd("2 0 1\n", 1)) + " ";
    const std::string far = write("f.pcd", asciiPcd("90 0 1\n", 1)) + " ";
    refused(pcd + "--every 1", "--every must be at least 2");
    refused(pcd + "--every 0", "--every must be at least 2");
    refused(pcd + "--every x", "--every");
    refused(pcd + pcd + "--every 2 --folds three", "--folds");
    refused(pcd + pcd + "--depth-scan 2", "--depth-picture");
    refused(pcd + pcd + "--every 2 --depth-scan 1 --depth-picture " + file("a.png"),
            "not held out");
    refused(pcd + pcd + "--every 2 --depth-picture " + file("a.svg"), "a.svg");
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
    const auto of = [&](const char* map, const char* figure) {
        return json["maps"][map]["cells_to_0.2_m"]["known"][figure].get<double>();
    };
    EXPECT_GT(of("AkiMap", "auc"), of("OctoMap", "auc"));
    EXPECT_LT(of("AkiMap", "brier"), of("OctoMap", "brier"));
    EXPECT_LT(of("AkiMap", "log_loss"), of("OctoMap", "log_loss"));
    // Nothing is asked of AkiMap beside its isotropic mode, which is the better one here.
}

}  // namespace
