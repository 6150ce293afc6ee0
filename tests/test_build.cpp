// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
//
// `akimap build` as its users run it: where poses come from, options, outputs.
#include <mrpt/system/filesystem.h>

#include "build_fixture.h"

namespace {

using namespace build_tests;

// Where the poses come from ---------------------------------------------------------------

TEST_F(Build, PosesFromATrajectory) {
    EXPECT_EQ(buildMap(plain("l.rawlog", walls()) + " --trajectory " + trajectory()),
              expectedMap());
    EXPECT_EQ(json()["scans"], kScans);
}

TEST_F(Build, PosesFromTheLogInterpolatedAndWhereverTheyStandInIt) {
    Objects log = walls();
    for (int i = 0; i < kScans; i += 2) log.push_back(robotPose(i, poseOf(i)));
    EXPECT_EQ(buildMap(plain("l.rawlog", log)), expectedMap());
}

TEST_F(Build, PosesFromTheIncrementsOfSensoryFrames) {
    Objects log;
    for (int i = 0; i < kScans; i++) {
        CActionRobotMovement2D movement;
        movement.computeFromOdometry(
            mrpt::poses::CPose2D(i == 0 ? CPose3D() : poseOf(i) - poseOf(i - 1)), {});
        auto actions = CActionCollection::Create();
        actions->insert(movement);
        auto frame = CSensoryFrame::Create();
        frame->insert(wall(i));
        log.push_back(actions);
        log.push_back(frame);
    }
    writeGz(file("l.rawlog"), log);
    EXPECT_EQ(buildMap(file("l.rawlog")), expectedMap());
}

TEST_F(Build, PosesFromOdometryObservations) {
    Objects log;
    for (int i = 0; i < kScans; i++) log.insert(log.end(), {odometry(i), wall(i)});
    EXPECT_EQ(buildMap(plain("l.rawlog", log)), expectedMap());
}

TEST_F(Build, ATrajectoryGoesBeforeTheLogsPosesAndTheseBeforeOdometry) {
    Objects log = walls();
    for (int i = 0; i < kScans; i++) {
        auto wrong = odometry(i);
        wrong->odometry.y(5);
        log.push_back(wrong);
        log.push_back(robotPose(i, poseOf(i)));
    }
    EXPECT_EQ(buildMap(plain("l.rawlog", log)), expectedMap());
    for (auto& object : log)
        if (auto pose = std::dynamic_pointer_cast<CObservationRobotPose>(object))
            pose->pose.mean.z(3);
    EXPECT_NE(buildMap(plain("l.rawlog", log)), expectedMap());
    EXPECT_EQ(buildMap(file("l.rawlog") + " --trajectory " + trajectory()), expectedMap());
}

TEST_F(Build, WithoutPosesAllIsSeenFromOnePlaceWithAWarning) {
    const auto run = build(plain("l.rawlog", walls()));
    EXPECT_EQ(run.exit, 0);
    EXPECT_TRUE(holds(run.err, "warning: " + file("l.rawlog"))) << run.err;
    AkiMap map;
    for (int i = 0; i < kScans; i++) map.insertObservation(*wall(i), CPose3D());
    map.saveToFile(file("expected.akimap"));
    EXPECT_EQ(fingerprint(file("m.akimap")), fingerprint(file("expected.akimap")));
}

TEST_F(Build, ASimplemapHasItsOwnPoses) {
    mrpt::maps::CSimpleMap map;
    for (int i = 0; i < kScans; i++) {
        const auto frame = CSensoryFrame::Create();
        frame->insert(wall(i));
        const mrpt::poses::CPose3DPDF::Ptr pose =
            mrpt::poses::CPose3DPDFGaussian::Create(poseOf(i));
        map.insert(pose, frame);
    }
    ASSERT_TRUE(map.saveToFile(file("l.simplemap")));
    EXPECT_EQ(buildMap(file("l.simplemap")), expectedMap());
    std::filesystem::copy(file("l.simplemap"), file("wrong.rawlog"));
    expectRefused(file("wrong.rawlog"), {"wrong.rawlog: not a rawlog", "CSimpleMap"});
    std::filesystem::copy(plain("l.rawlog", walls()), file("wrong.simplemap"));
    expectRefused(file("wrong.simplemap"), {"wrong.simplemap: not a simplemap"});
    write("cut.simplemap", readText(file("l.simplemap")).substr(0, 100));
    expectRefused(file("cut.simplemap"), {"cut.simplemap: ", "ends"});
}

TEST_F(Build, OneCRawlogObjectIsARawlogToo) {
    CRawlog log;
    for (int i = 0; i < kScans; i++) {
        log.insert(robotPose(i, poseOf(i)));
        log.insert(wall(i));
    }
    writeGz(file("l.rawlog"), {CRawlog::Create(log)});
    EXPECT_EQ(buildMap(file("l.rawlog")), expectedMap());
}

// What is skipped -------------------------------------------------------------------------

TEST_F(Build, ScansOutsideTheTrajectoryAreSkippedAndCounted) {
    const std::string log = plain("l.rawlog", walls());
    const auto run = build(log + " --trajectory " + trajectory(0, 2));
    EXPECT_EQ(run.exit, 0) << run.err;
    EXPECT_EQ(fingerprint(file("m.akimap")), expectedMap(3));
    EXPECT_EQ(json()["skipped_scans_trajectory"], 2);
    EXPECT_TRUE(holds(run.out, "scans outside the trajectory")) << run.out;
}

TEST_F(Build, MaxGapIsTheLargestGapBridged) {
    const std::string log = plain("l.rawlog", walls());
    std::string text = readText(trajectory());
    for (int i = 0; i < 3; i++) {  // drop the samples of scans 1 to 3
        const auto start = text.find('\n', text.find('\n') + 1) + 1;
        text.erase(start, text.find('\n', start) + 1 - start);
    }
    const std::string gappy = write("gappy.tum", text);
    buildMap(log + " --trajectory " + gappy);
    EXPECT_EQ(json()["skipped_scans_trajectory"], 3) << "1 s is more than the default 0.5 s";
    EXPECT_EQ(buildMap(log + " --max-gap 1 --trajectory " + gappy), expectedMap());
}

TEST_F(Build, UnusableClassesAreCountedByName) {
    Objects log = walls();
    for (int i = 0; i < 3; i++) log.push_back(atTimeOf<CObservationImage>(i));
    log.push_back(atTimeOf<CObservationComment>(0));
    const auto run = build(plain("l.rawlog", log) + " --trajectory " + trajectory());
    EXPECT_EQ(run.exit, 0) << run.err;
    EXPECT_EQ(json()["skipped_observations"], 3);
    EXPECT_EQ(json()["skipped_observations_CObservationImage"], 3);
    EXPECT_TRUE(holds(run.out, "CObservationImage")) << run.out;
    EXPECT_FALSE(holds(run.out, "Comment")) << run.out;
}

TEST_F(Build, UnusablePointsAndEmptyScansAreCounted) {
    const std::string points =
        "2 0 1\n2 .1 1\nnan 0 0\n0 inf 0\n0 0 1\n.2 0 1\n4.6e5 0 1\n4.3e5 0 1\n";
    const std::string log = plain("l.rawlog", walls());
    const std::string pcd = write("p.pcd", asciiPcd(points, 8));
    const std::string empty = write("e.pcd", asciiPcd("", 0));
    const auto run = build(empty + " " + pcd + " --max-range 4.5e5 --min-range 0.5");
    EXPECT_EQ(run.exit, 0) << run.err;
    const auto counts = json();
    EXPECT_EQ(counts["scans"], 1);
    EXPECT_EQ(counts["points"], 2);
    EXPECT_EQ(counts["skipped_points_nonfinite"], 2);
    EXPECT_EQ(counts["skipped_points_zero_length"], 1);
    EXPECT_EQ(counts["skipped_points_range"], 2);
    EXPECT_EQ(counts["skipped_points_grid"], 1);
    EXPECT_EQ(counts["skipped_scans_empty"], 1);
    for (const char* name : {"not finite", "at their ray's origin", "out of range",
                             "beyond the grid", "scans without a usable point"})
        EXPECT_TRUE(holds(run.out, name)) << run.out << "lacks " << name;
}

TEST_F(Build, OnlyOneSensorAndOnlyTheFirstScans) {
    Objects log;
    for (int i = 0; i < kScans; i++) log.insert(log.end(), {wall(i), wall(i, "other")});
    plain("l.rawlog", log);
    const std::string with_poses = file("l.rawlog") + " --trajectory " + trajectory();
    EXPECT_EQ(buildMap(with_poses + " --only lidar"), expectedMap());
    EXPECT_EQ(json()["skipped_scans_label"], kScans);
    EXPECT_EQ(buildMap(with_poses + " --only lidar --first 3"), expectedMap(3));
    buildMap(with_poses + " " + file("l.rawlog") + " --first 7");
    EXPECT_EQ(json()["scans"], 7) << "of all inputs together";
    expectRefused(with_poses + " --only lydar", {"nothing usable", "lydar", "lidar, other"});
}

// Options and outputs ---------------------------------------------------------------------

TEST_F(Build, TheCommandLineWinsOverTheIni) {
    const std::string pcd = write("p.pcd", asciiPcd("2 0 1\n5 0 1\n9 0 1\n", 3));
    const std::string ini =
        " -c " +
        write("c.ini",
              "[map]\nakimap_count = 1\n[map_akimap_00_creationOpts]\nresolution = 0.1\n"
              "[map_akimap_00_insertOpts]\nmax_range = 3\nbandwidth = isotropic\n"
              "[map_akimap_00_likelihoodOpts]\ndecimation = 7\n") +
        " --section map";
    buildMap(pcd + ini);
    EXPECT_EQ(json()["points"], 1);
    buildMap(pcd + ini + " --max-range 6 --bandwidth covariance --seed 9 --threads 1");
    EXPECT_EQ(json()["points"], 2);
    const auto map = AkiMap::loadFromFile(file("m.akimap"));
    EXPECT_EQ(map->resolution(), 0.1);
    EXPECT_EQ(map->insertionOptions.max_range, 6);
    EXPECT_EQ(map->insertionOptions.bandwidth, akimap::Bandwidth::covariance);
    EXPECT_EQ(map->insertionOptions.seed, 9u);
    EXPECT_EQ(map->likelihoodOptions.decimation, 7u);
    buildMap(pcd + ini + " --resolution 0.2");
    EXPECT_EQ(AkiMap::loadFromFile(file("m.akimap"))->resolution(), 0.2);
}

TEST_F(Build, TheCommandLineAndTheIniMeanTheSame) {
    const std::string pcd = write("p.pcd", asciiPcd("2 0 1\n2 .1 1\n2 .2 1\n", 3));
    const auto ini = [&](const std::string& options) {
        return " -c " + write("c.ini",
                              "[MappingApplication]\nakimap_count = 1\n"
                              "[MappingApplication_akimap_00_insertOpts]\n" +
                                  options);
    };
    const std::string isotropic = buildMap(pcd + " --bandwidth isotropic");
    EXPECT_EQ(isotropic, buildMap(pcd + ini("bandwidth = isotropic\n")));
    EXPECT_EQ(AkiMap::loadFromFile(file("m.akimap"))->insertionOptions.estimator,
              akimap::Estimator::surface);
    const std::string paper = buildMap(pcd + " --estimator paper --bandwidth isotropic");
    EXPECT_NE(isotropic, paper);
    EXPECT_EQ(paper, buildMap(pcd + ini("estimator = paper\nbandwidth = isotropic\n")));
    EXPECT_EQ(paper, buildMap(pcd + ini("estimator = paper\n") + " --bandwidth isotropic"));
}

TEST_F(Build, JsonAndTableAgreeWithTheMap) {
    const auto run = build(plain("l.rawlog", walls()) + " --trajectory " + trajectory());
    ASSERT_EQ(run.exit, 0) << run.err;
    EXPECT_EQ(run.err, "") << "no progress bar without a terminal";
    const auto map = AkiMap::loadFromFile(file("m.akimap"));
    const auto counts = json();
    EXPECT_EQ(counts["cells"], map->cellCount());
    EXPECT_EQ(counts["points"], kScans * 17 * 17);
    EXPECT_GT(counts["samples_occupied"], 0);
    EXPECT_GT(counts["samples_free"], 0);
    EXPECT_GT(counts["map_bytes"], counts["cells"].get<double>());
    EXPECT_GT(counts["peak_rss_bytes"], counts["map_bytes"]);
    const double stages = counts["seconds_sampling"].get<double>() +
                          counts["seconds_bandwidth"].get<double>() +
                          counts["seconds_update"].get<double>();
    EXPECT_GT(stages, 0);
    EXPECT_LE(stages, counts["insertion_seconds"].get<double>());
    for (const auto& value : counts) EXPECT_TRUE(value.is_number()) << value;
    EXPECT_TRUE(holds(run.out, std::to_string(map->cellCount()))) << run.out;
    EXPECT_FALSE(holds(run.out, "skipped")) << "there is nothing to tell\n" << run.out;
    EXPECT_EQ(build(file("l.rawlog") + " --quiet --trajectory " + file("t.tum")).out, "");
}

TEST_F(Build, TheSeedMattersAndTheThreadsDoNot) {
    const std::string log = plain("l.rawlog", walls()) + " --trajectory " + trajectory();
    const std::string map = buildMap(log + " --threads 1");
    const auto insertion = [&] { return AkiMap::loadFromFile(file("m.akimap"))->cellCount(); };
    const auto cells = insertion();
    buildMap(log + " --threads 3");
    EXPECT_EQ(insertion(), cells);
    EXPECT_NE(buildMap(log + " --threads 1 --seed 2"), map);
}

TEST_F(Build, ExportsAreWritten) {
    const std::string pcd = write("p.pcd", asciiPcd("2 0 1\n", 1));
    buildMap(pcd + " --export " + file("m.csv") + " --export " + file("m.bt"));
    EXPECT_EQ(readText(file("m.csv")).find("x,y,z,occupancy,alpha,beta\n"), 0u);
    EXPECT_TRUE(std::filesystem::exists(file("m.bt")));
}

// External images -------------------------------------------------------------------------

TEST_F(Build, DepthImagesBesideTheRawlogAreFound) {
    auto depth = atTimeOf<CObservation3DRangeScan>(0);
    depth->hasRangeImage = true;
    depth->rangeImage_setSize(24, 32);
    depth->rangeImage.fill(1500);
    depth->rangeUnits = 0.001f;
    depth->cameraParams.nrows = 24;
    depth->cameraParams.ncols = 32;
    depth->cameraParams.setIntrinsicParamsFromValues(30, 30, 16, 12);
    const std::string inside = buildMap(plain("in.rawlog", {depth}));
    EXPECT_EQ(json()["points"], 24 * 32);

    const std::string images = file("out_Images");
    std::filesystem::create_directory(images);
    depth->rangeImage_convertToExternalStorage("depth.bin", images + "/");
    EXPECT_EQ(buildMap(plain("out.rawlog", {depth})), inside);
    std::filesystem::remove(images + "/depth.bin");
    expectRefused(file("out.rawlog"), {file("out.rawlog") + ": "});
}

// Whole data sets -------------------------------------------------------------------------

TEST_F(Build, AMovingVelodyneNeedsAPoseForEachPacket) {
    const auto simulated =
        runProgram("simulate structured --sensor velodyne --moving -o " + folder.path().string());
    ASSERT_EQ(simulated.exit, 0) << simulated.err;
    const auto known_auc = [&](const std::string& input) {
        buildMap(input);
        const auto run = runProgram("eval " + file("m.akimap") + " --truth " + file("truth.bt") +
                                    " --json " + file("e.json"));
        EXPECT_EQ(run.exit, 0) << run.err;
        return nlohmann::json::parse(readText(file("e.json")))["known_auc"].get<double>();
    };
    // The simplemap holds the same scans with one pose each.
    const double ignored = known_auc(file("scene.simplemap"));
    const double heeded =
        known_auc(file("scene.rawlog") + " --trajectory " + file("trajectory.tum"));
    EXPECT_GT(heeded, ignored + 0.05);
}

TEST_F(Build, TheLogsThatComeWithMrpt) {
    const std::string data = mrpt::system::getShareMRPTDir() + "datasets/";
    if (!std::filesystem::exists(data)) GTEST_SKIP() << "no data sets in " << data;
    buildMap(data + "test_velodyne_VLP16.rawlog");
    EXPECT_EQ(json()["points"].get<int>() + json()["skipped_points_range"].get<int>(), 11305);
    buildMap(data + "tests_rgbd.rawlog");
    EXPECT_EQ(json()["points"], 273225);
    const auto laser =
        build("'" + data + "2006-01ENE-21-SENA_Telecom Faculty_one_loop_only.rawlog'" +
              " --max-range 80 --resolution 0.2");
    EXPECT_EQ(laser.exit, 0);
    EXPECT_EQ(laser.err, "") << "it has odometry";
    EXPECT_EQ(json()["scans"], 225);
}

TEST_F(Build, TheCorridorsPointClouds) {
    const char* data = std::getenv("AKIMAP_DATA");
    if (!data || !std::filesystem::exists(std::string(data) + "/corridor"))
        GTEST_SKIP() << "no corridor/ in AKIMAP_DATA";
    std::string clouds;
    for (int i = 1; i <= 16; i++)
        clouds += "'" + std::string(data) + "/corridor/corridor_" + std::to_string(i) + ".pcd' ";
    buildMap(clouds);
    EXPECT_EQ(json()["scans"], 16);
    const auto map = AkiMap::loadFromFile(file("m.akimap"));
    EXPECT_GT(map->occupiedCells().size(), 10000u);
}

}  // namespace
