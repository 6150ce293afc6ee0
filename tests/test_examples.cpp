// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers

// Runs the programs of examples/ as their comments say.
#include <akimap/AkiMap.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <iostream>

#include "run_program.h"

namespace {

namespace fs = std::filesystem;

const std::string kDatasets = "/usr/share/mrpt/datasets/";
const std::string kIni = std::string("'") + AKIMAP_SOURCE_DIR + "/share/akimap/akimap.ini'";

/** The command line of an example. */
std::string example(const std::string& name) {
    const fs::path build = fs::path(AKIMAP_LIBRARY).parent_path().parent_path();
    return "'" + (build / "examples" / name).string() + "' ";
}

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

TEST(Examples, InsertAndQueryTellsTheWallFromItsSurroundings) {
    const auto run = runCommand(example("insert_and_query"));
    EXPECT_EQ(run.exit, 0) << run.err;
    EXPECT_TRUE(contains(run.out, "on the wall: occupied, ")) << run.out;
    EXPECT_TRUE(contains(run.out, "in front of it: free, ")) << run.out;
    EXPECT_TRUE(contains(run.out, "behind it: unknown\n")) << run.out;
}

TEST(Examples, MultiMetricMapInsertsAVelodyneScanIntoTheMapOfTheIni) {
    const auto run = runCommand(example("multi_metric_map") + kIni + " " + kDatasets +
                                "test_velodyne_VLP16.rawlog");
    EXPECT_EQ(run.exit, 0) << run.err;
    EXPECT_TRUE(contains(run.out, "akimap::AkiMap: ")) << run.out;
    EXPECT_TRUE(contains(run.out, " occupied cells of 0.05 m")) << run.out;
    EXPECT_FALSE(contains(run.out, "\n0 occupied")) << run.out;
}

TEST(Examples, MultiMetricMapSaysWhatIsMissing) {
    const auto no_map = runCommand(example("multi_metric_map") + kIni + " " + kDatasets +
                                   "test_velodyne_VLP16.rawlog NoSuchSection");
    EXPECT_EQ(no_map.exit, 1);
    EXPECT_TRUE(contains(no_map.err, "[NoSuchSection]")) << no_map.err;
    const auto no_log = runCommand(example("multi_metric_map") + kIni + " /nonexistent.rawlog");
    EXPECT_EQ(no_log.exit, 1);
    EXPECT_TRUE(contains(no_log.err, "/nonexistent.rawlog")) << no_log.err;
}

TEST(Examples, ReplayFollowsTheOdometryOfAnActionsLog) {
    const TemporaryFolder folder;
    const std::string file = folder.file("faculty.akimap");
    const auto run = runCommand(example("replay_rawlog") + "'" + kDatasets +
                                "2006-01ENE-21-SENA_Telecom Faculty_one_loop_only.rawlog' " + file);
    ASSERT_EQ(run.exit, 0) << run.err;
    const auto map = akimap::AkiMap::loadFromFile(file);
    const auto box = map->boundingBox();
    // A loop through corridors; without odometry all scans would lie on one spot, 16 m wide.
    EXPECT_GT(box.max.x - box.min.x, 25);
    EXPECT_GT(box.max.y - box.min.y, 25);
}

TEST(Examples, ReplayReadsAnObservationsLog) {
    const TemporaryFolder folder;
    const std::string file = folder.file("velodyne.akimap");
    const auto run =
        runCommand(example("replay_rawlog") + kDatasets + "test_velodyne_VLP16.rawlog " + file);
    ASSERT_EQ(run.exit, 0) << run.err;
    EXPECT_TRUE(contains(run.out, "1 scans: ")) << run.out;
    EXPECT_FALSE(akimap::AkiMap::loadFromFile(file)->isEmpty());
    EXPECT_EQ(runCommand(example("replay_rawlog") + "/nonexistent.rawlog " + file).exit, 1);
}

TEST(Examples, IcpFindsThePoseOfAScan) {
    const auto run = runCommand(example("align_with_icp"));
    EXPECT_EQ(run.exit, 0) << run.out << run.err;  // it measures its own error
    EXPECT_TRUE(contains(run.out, " m from the truth")) << run.out;
}

/** The number that stands before " of 30" behind the method's name; -1 if it is not there. */
int convergedOf30(const std::string& text, const std::string& method) {
    const auto at = text.find(method + ": ");
    int n = -1, of = 0;
    if (at == std::string::npos ||
        std::sscanf(text.c_str() + at + method.size() + 2, "%d of %d", &n, &of) != 2 || of != 30)
        return -1;
    return n;
}

TEST(Examples, PointToPlaneFindsThePosesOfScansThatTheMapHasNotSeen) {
    const TemporaryFolder folder;
    ASSERT_EQ(
        runProgram("simulate structured --sensor velodyne --with-poses --truth-resolution 0.5 -o " +
                   folder.path().string())
            .exit,
        0);
    const auto run = runCommand(example("align_point_to_plane") + folder.file("scene.rawlog"));
    EXPECT_EQ(run.exit, 0) << run.err;
    std::cout << run.out;
    EXPECT_EQ(convergedOf30(run.out, "point to plane"), 30);
    EXPECT_GE(convergedOf30(run.out, "point to plane"), convergedOf30(run.out, "point to point"));
    EXPECT_GE(convergedOf30(run.out, "point to point"), 0);
    const auto no_log = runCommand(example("align_point_to_plane") + "/nonexistent.rawlog");
    EXPECT_EQ(no_log.exit, 1);
    EXPECT_TRUE(contains(no_log.err, "/nonexistent.rawlog")) << no_log.err;
    const auto no_poses =
        runCommand(example("align_point_to_plane") + kDatasets + "test_velodyne_VLP16.rawlog");
    EXPECT_EQ(no_poses.exit, 1);
    EXPECT_TRUE(contains(no_poses.err, "no robot poses in it; akimap convert")) << no_poses.err;
}

TEST(Examples, AWindowShowsAMapAndClosesByItself) {
    const TemporaryFolder folder;
    const std::string file = folder.file("velodyne.akimap");
    ASSERT_EQ(
        runCommand(example("replay_rawlog") + kDatasets + "test_velodyne_VLP16.rawlog " + file)
            .exit,
        0);
    if (runCommand("command -v xvfb-run").exit != 0) GTEST_SKIP() << "needs the package xvfb";
    const auto run = runCommand("LIBGL_ALWAYS_SOFTWARE=1 xvfb-run -a " + example("show_in_window") +
                                file + " --seconds 2");
    EXPECT_EQ(run.exit, 0) << run.out << run.err;

    const auto no_display = runCommand("env -u DISPLAY " + example("show_in_window") + file);
    EXPECT_EQ(no_display.exit, 1);
    EXPECT_TRUE(contains(no_display.err, "no display")) << no_display.err;
    const auto no_file = runCommand(example("show_in_window") + "/nonexistent.akimap");
    EXPECT_EQ(no_file.exit, 1);
    EXPECT_TRUE(contains(no_file.err, "/nonexistent.akimap")) << no_file.err;
}

}  // namespace
