// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
//
// `akimap convert` and `akimap check`.
#include <mrpt/maps/CPointsMapXYZI.h>

#include "alike.h"
#include "build_fixture.h"
#include "input/ObjectReader.h"

namespace {

using namespace build_tests;

class Convert : public Build {
 protected:
    /** A wall at x = 5.013 of the map, from which the sensor drives away. \return the arguments */
    std::string clouds() const {
        std::filesystem::create_directories(file("scans"));
        std::string poses;
        for (int i = 0; i < kScans; i++) {
            std::string points = "x,y,z,intensity\n";
            for (int k = 0; k < 400; k++)
                points += std::to_string(5 + 0.5 * i) + "," +
                          std::to_string(0.1 * (k % 20) - 0.987) + "," +
                          std::to_string(0.1 * (k / 20) - 0.987) + "," + std::to_string(k) + "\n";
            write("scans/" + std::to_string(i) + ".csv", points);
            poses += "1 0 0 " + std::to_string(0.013 - 0.5 * i) + " 0 1 0 0.013 0 0 1 0.013\n";
        }
        return file("scans") + " --poses " + write("poses.txt", poses);
    }
    ::Run convert(const std::string& arguments, const std::string& out) const {
        return runProgram("convert " + arguments + " -o " + file(out));
    }
    /** The lines that `check` prints, which must succeed. */
    std::string check(const std::string& arguments) const {
        const auto run = runProgram("check " + arguments + " --json " + file("c.json"));
        EXPECT_EQ(run.exit, 0) << run.err;
        return run.out;
    }
    nlohmann::json figures() const { return nlohmann::json::parse(readText(file("c.json"))); }
};

TEST_F(Convert, CloudsGiveTheSameMapByRawlogAndSimplemap) {
    buildMap(clouds());
    const std::string direct = file("direct.akimap");  // whose points are no floats
    std::filesystem::rename(file("m.akimap"), direct);
    for (const char* out : {"o.rawlog", "o.simplemap"}) {
        const auto run = convert(clouds(), out);
        ASSERT_EQ(run.exit, 0) << run.err;
        EXPECT_EQ(run.out, "5 scans with poses in " + file(out) + "\n");
        buildMap(file(out));
        EXPECT_EQ(json()["scans"], kScans);
        EXPECT_EQ(json()["points"], kScans * 400);
        EXPECT_GT(akimap::test::alike(file("m.akimap"), direct), 0.999) << out;
    }
}

TEST_F(Convert, IntensitiesAndPosesAreKept) {
    ASSERT_EQ(convert(clouds(), "o.rawlog").exit, 0);
    using namespace akimap::app;
    ObjectReader reader(CheckedLog(file("o.rawlog"), ExternalFiles::beside_log));
    const auto pose = std::dynamic_pointer_cast<CObservationRobotPose>(reader.next());
    const auto cloud = std::dynamic_pointer_cast<CObservationPointCloud>(reader.next());
    ASSERT_TRUE(pose && cloud);
    EXPECT_EQ(pose->timestamp, cloud->timestamp);
    const auto points = std::dynamic_pointer_cast<mrpt::maps::CPointsMapXYZI>(cloud->pointcloud);
    ASSERT_TRUE(points);
    ASSERT_EQ(points->size(), 400u);
    EXPECT_EQ(points->getPointIntensity(399), 399);
}

TEST_F(Convert, ARawlogWithATrajectoryBecomesOneWithPoses) {
    const std::string log = plain("l.rawlog", walls()) + " --trajectory " + trajectory();
    for (const char* out : {"o.rawlog", "o.simplemap"}) {
        ASSERT_EQ(convert(log, out).exit, 0);
        EXPECT_EQ(buildMap(file(out)), expectedMap()) << out;
    }
}

TEST_F(Convert, AMovingVelodyneKeepsThePosesOfItsPackets) {
    ASSERT_EQ(
        runProgram("simulate structured --sensor velodyne --moving -o " + folder.path().string())
            .exit,
        0);
    const std::string log = file("scene.rawlog") + " --trajectory " + file("trajectory.tum");
    ASSERT_EQ(convert(log, "o.rawlog").exit, 0);
    EXPECT_EQ(buildMap(file("o.rawlog")), buildMap(log));
}

TEST_F(Convert, ObservationsToMapMakesTheSameMap) {
    if (runCommand("which observations2map").exit != 0) GTEST_SKIP() << "no observations2map";
    ASSERT_EQ(convert(clouds(), "o.simplemap").exit, 0);
    const std::string ini =
        std::string(AKIMAP_SOURCE_DIR) + "/share/akimap/config_files/observations2map.ini";
    const auto run =
        runCommand("cd '" + folder.path().string() + "' && LD_PRELOAD='" + AKIMAP_LIBRARY +
                   "' observations2map '" + ini + "' o.simplemap out");
    ASSERT_EQ(run.exit, 0) << run.err;
    buildMap(clouds());
    EXPECT_GT(akimap::test::alike(file("out_akimap__AkiMap_00.akimap"), file("m.akimap")), 0.999);
}

TEST_F(Convert, WhatCannotBeIsRefused) {
    const auto refused = [&](const std::string& arguments, const std::string& out,
                             const std::string& part) {
        const auto run = convert(arguments, out);
        EXPECT_EQ(run.exit, 1);
        EXPECT_TRUE(holds(run.err, part)) << run.err;
        EXPECT_FALSE(std::filesystem::exists(file(out)));
    };
    refused(clouds(), "o.bag", "o.bag: convert writes .rawlog and .simplemap");
    refused(write("n.pcd", "no pcd"), "o.rawlog", "n.pcd: line 1");
    refused(plain("i.rawlog", {atTimeOf<CObservationImage>(0)}), "o.rawlog", "nothing usable");
    const std::string log = plain("l.rawlog", walls());
    const std::string before = readText(log);
    EXPECT_EQ(convert(log, "l.rawlog").exit, 1) << "its own input";
    EXPECT_EQ(readText(log), before);
}

TEST_F(Convert, CheckTellsWhatIsThere) {
    const std::string out = check(clouds());
    for (const char* part : {"scans                  5", "400", "in the order of the files",
                             "way                    2.00 m", "looks wrong            nothing"})
        EXPECT_TRUE(holds(out, part)) << out << "lacks " << part;
    EXPECT_EQ(figures()["scans"], 5);
    EXPECT_EQ(figures()["agreement"], 1);
    EXPECT_NEAR(figures()["highest"][0].get<double>(), 5.013, 1e-6);
}

TEST_F(Convert, CheckTellsOfPosesThatDoNotMatch) {
    clouds();
    std::string inverted, jump;
    for (int i = 0; i < kScans; i++) {
        inverted += "1 0 0 " + std::to_string(0.5 * i) + " 0 1 0 0 0 0 1 0\n";
        jump += "1 0 0 " + std::to_string(-0.5 * i - (i == 4 ? 30 : 0)) + " 0 1 0 0 0 0 1 0\n";
    }
    const std::string scans = file("scans") + " --poses ";
    EXPECT_TRUE(holds(check(scans + write("i.txt", inverted)), "the inverses of the poses match"));
    EXPECT_LT(figures()["agreement"], 0.5);
    EXPECT_EQ(figures()["agreement_inverted"], 1);
    EXPECT_TRUE(holds(check(scans + write("j.txt", jump)), "a jump of 30.50 m from scan 4"));
    EXPECT_TRUE(holds(check(plain("l.rawlog", walls())), "one and the same pose"));
    Objects log{wall(1), wall(0), robotPose(0, poseOf(0)), robotPose(1, poseOf(1))};
    EXPECT_TRUE(holds(check(plain("o.rawlog", log)), "1 times are earlier"));
}

}  // namespace
