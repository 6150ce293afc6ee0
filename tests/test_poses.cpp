// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
//
// Poses in the forms that people have, and how each scan gets its own.
#include <gtest/gtest.h>

#include <cmath>

#include "input/natural_order.h"
#include "input/poses/FramePoses.h"
#include "input/poses/pose_file.h"
#include "run_program.h"

namespace {

using namespace akimap::app;
using mrpt::poses::CPose3D;

constexpr double kDegree = M_PI / 180;

class Poses : public ::testing::Test {
 protected:
    std::string write(const std::string& name, const std::string& text) const {
        std::filesystem::create_directories(std::filesystem::path(folder.file(name)).parent_path());
        writeText(folder.file(name), text);
        return folder.file(name);
    }
    PoseList read(const std::string& text) const { return readPoses(write("p.txt", text)); }
    /** The message of what is thrown. */
    template <class Act>
    static std::string refusal(Act&& act) {
        try {
            act();
        } catch (const std::runtime_error& e) {
            return e.what();
        }
        return "nothing thrown";
    }
    static void expectHolds(const std::string& text, const std::string& part) {
        EXPECT_NE(text.find(part), std::string::npos) << text << "\nlacks " << part;
    }
    static void expectPose(const CPose3D& p, double x, double y, double z, double yaw_degrees) {
        EXPECT_NEAR(p.x(), x, 1e-9);
        EXPECT_NEAR(p.y(), y, 1e-9);
        EXPECT_NEAR(p.z(), z, 1e-9);
        EXPECT_NEAR(p.yaw(), yaw_degrees * kDegree, 1e-6);
        EXPECT_NEAR(p.pitch(), 0, 1e-6);
        EXPECT_NEAR(p.roll(), 0, 1e-6);
    }
    TemporaryFolder folder;
};

// Forms -----------------------------------------------------------------------------------

/** Two poses in each form: at 0, and at (1, 2, 3) turned left by 90 degrees. */
struct Form {
    const char* name;
    const char* text;
};
constexpr Form kForms[] = {
    {"KITTI poses", "1 0 0 0 0 1 0 0 0 0 1 0\n0 -1 0 1 1 0 0 2 0 0 1 3\n"},
    {"4 x 4 matrices",
     "1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n\n0 -1 0 1\n1 0 0 2\n0 0 1 3\n0 0 0 1\n"},
    {"4 x 4 matrices", "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1\n0 -1 0 1 1 0 0 2 0 0 1 3 0 0 0 1\n"},
    {"TUM trajectory", "# t\n10 0 0 0 0 0 0 1\r\n11 1 2 3 0 0 .7071067812 .7071067812\n"},
    {"Open3D's log",
     "0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n1 1 2\n0 -1 0 1\n1 0 0 2\n0 0 1 3\n0 0 0 1\n"},
    {"g2o vertices",
     "VERTEX_SE3:QUAT 7 1 2 3 0 0 .7071067812 .7071067812\nVERTEX_SE3:QUAT 2 0 0 0 0 0 0 1\n"
     "EDGE_SE3:QUAT 2 7 1 0 0 0 0 0 1 nan\n"}};

TEST_F(Poses, OfEveryFormAreTheSame) {
    for (const Form& form : kForms) {
        SCOPED_TRACE(form.name);
        const PoseList list = read(form.text);
        EXPECT_EQ(list.form, form.name);
        ASSERT_EQ(list.poses.size(), 2u);
        expectPose(list.poses[0], 0, 0, 0, 0);
        expectPose(list.poses[1], 1, 2, 3, 90);
        EXPECT_EQ(list.times.size(), std::string(form.name) == "TUM trajectory" ? 2u : 0u);
    }
    expectPose(read("VERTEX_SE2 0 1 2 1.5707963268\n").poses.at(0), 1, 2, 0, 90);
}

TEST_F(Poses, WhatIsNoneIsRefusedWithItsLine) {
    const auto refused = [&](const std::string& text) {
        return refusal([&] { (void)read(text); });
    };
    const std::string kitti = "1 0 0 0 0 1 0 0 0 0 1 0\n";
    expectHolds(refused(kitti + "1 0 0 0 0 1 0 0 0 0 1\n"), "p.txt:2: expected 12 numbers");
    expectHolds(refused(kitti + "1 0 0 0 0 1 0 0 0 0 one 0\n"), "p.txt:2: 'one'");
    expectHolds(refused(kitti + "2 0 0 0 0 1 0 0 0 0 1 0\n"), "p.txt:2: the left 3 x 3");
    expectHolds(refused("1 0 0 0 0 1 0 0 0 0 -1 0\n"),
                "p.txt:1: the left 3 x 3 numbers of the pose are a mirror");
    expectHolds(refused("1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 1 1\n"), "last row");
    expectHolds(refused("1 0 0 0\n0 1 0 0\n0 0 1 0\n"), "p.txt:3: the last pose ends here");
    expectHolds(refused("1 2 3 4 5\n"), "p.txt:1: expected 8 numbers (TUM");
    expectHolds(refused("# none\n"), "p.txt: it holds no poses");
    expectHolds(refused("VERTEX_SE2 0 1 2 3\nVERTEX_SE2 0 1 2 3\n"), "p.txt:2: a second vertex 0");
    expectHolds(refusal([&] { (void)readPoses(folder.file("none")); }), "none: no such file");
}

TEST_F(Poses, OfTheCommandLine) {
    expectPose(poseArgument("--extrinsic", "1,2,3,90,0,0"), 1, 2, 3, 90);
    expectPose(poseArgument("--extrinsic", "0 -1 0 1 1 0 0 2 0 0 1 3"), 1, 2, 3, 90);
    expectPose(poseArgument("--extrinsic", write("m.txt", "0 -1 0 1\n1 0 0 2\n0 0 1 3\n0 0 0 1\n")),
               1, 2, 3, 90);
    expectPose(
        poseArgument("--extrinsic", write("calib.txt",
                                          "P0: 7 0 0 0 0 7 0 0 0 0 1 0\nTr: 0 -1 0 1 1 0 0 2 0 "
                                          "0 1 3\n")),
        1, 2, 3, 90);
    const auto refused = [](const std::string& text) {
        return refusal([&] { (void)poseArgument("--extrinsic", text); });
    };
    expectHolds(refused("1,2,3"), "--extrinsic: expected x,y,z,yaw,pitch,roll");
    expectHolds(refused("none.txt"), "--extrinsic: none.txt: no such file");
    expectHolds(refused(write("bad.txt", "1 2 three")), "bad.txt: 'three'");
}

// Which scan has which --------------------------------------------------------------------

/** As many lines x 0 0, x from 1 on, by KITTI. */
std::string kittiLine(int count) {
    std::string text;
    for (int i = 1; i <= count; i++) text += "1 0 0 " + std::to_string(i) + " 0 1 0 0 0 0 1 0\n";
    return text;
}

std::vector<double> placesOf(const FramePoses& frames) {
    std::vector<double> places;
    for (const auto& pose : frames.poses) places.push_back(pose ? pose->x() : std::nan(""));
    return places;
}
using Places = std::vector<double>;

TEST_F(Poses, InTheOrderOfTheFilesThereMustBeAsMany) {
    const std::string poses = write("k.txt", kittiLine(3));
    EXPECT_EQ(placesOf(matchPoses({"a.pcd", "b.pcd", "c.pcd"}, poses, "", 0.5)), Places({1, 2, 3}));
    const std::string why = refusal([&] { (void)matchPoses({"a.pcd", "b.pcd"}, poses, "", 0.5); });
    expectHolds(why, "k.txt: 3 poses (KITTI poses) for 2 scans");
}

constexpr const char* kTum = "5 5 0 0 0 0 0 1\n6 6 0 0 0 0 0 1\n7 7 0 0 0 0 0 1\n";

TEST_F(Poses, ByTheNumbersInNamesIfEachIsATime) {
    const std::string poses = write("t.tum", kTum);
    EXPECT_EQ(placesOf(matchPoses({"scan_05.pcd", "scan_07.pcd"}, poses, "", 0.5)), Places({5, 7}));
    // 0, 1 and 2 are no times of it: in order
    EXPECT_EQ(placesOf(matchPoses({"s0.pcd", "s1.pcd", "s2.pcd"}, poses, "", 0.5)),
              Places({5, 6, 7}));
    expectHolds(refusal([&] {
                    (void)matchPoses({"s0.pcd", "s1.pcd"}, poses, "", 0.5);
                }),
                "3 poses (TUM trajectory) for 2 scans, whose names are no times; --times FILE");
}

TEST_F(Poses, ByTimesInNamesBetweenThePoses) {
    const std::string poses =
        write("t.tum", "1305031102.1 1 0 0 0 0 0 1\n1305031102.3 3 0 0 0 0 0 1\n");
    const auto at = [&](const std::vector<std::string>& files) {
        return placesOf(matchPoses(files, poses, "", 0.5));
    };
    EXPECT_NEAR(at({"d/1305031102.200000.png"}).at(0), 2, 1e-4);
    EXPECT_NEAR(at({"1305031102150000000.bin"}).at(0), 1.5, 1e-4) << "nanoseconds";
    EXPECT_NEAR(at({"x_1305031102250000.bin"}).at(0), 2.5, 1e-4) << "microseconds";
    EXPECT_NEAR(at({"1305031102250.bin"}).at(0), 2.5, 1e-4) << "milliseconds";
    const auto half = at({"1305031102.2.png", "1305031102.9.png"});
    EXPECT_NEAR(half[0], 2, 1e-4);
    EXPECT_TRUE(std::isnan(half[1])) << "behind the last pose";
    expectHolds(refusal([&] { (void)at({"1405031102.2.png"}); }), "covers no scan");
}

TEST_F(Poses, ByAFileOfTimes) {
    const std::string poses = write("t.tum", kTum);
    const std::string times = write("times.txt", "# s\n5.0 a.png\n7.0 b.png\n");
    EXPECT_EQ(placesOf(matchPoses({"a.png", "b.png"}, poses, times, 2)), Places({5, 7}));
    expectHolds(refusal([&] { (void)matchPoses({"a.png"}, poses, times, 2); }),
                "times.txt: 2 times for 1 scan");
}

TEST_F(Poses, OneFileAFrameByNameOrNumber) {
    write("poses/frame-000010.pose.txt", "1 0 0 10\n0 1 0 0\n0 0 1 0\n0 0 0 1\n");
    write("poses/frame-000020.pose.txt", "1 0 0 20\n0 1 0 0\n0 0 1 0\n0 0 0 1\n");
    write("poses/camera-intrinsics.txt", "1 0 0\n0 1 0\n0 0 1\n");
    const std::string poses = folder.file("poses");
    EXPECT_EQ(
        placesOf(matchPoses({"frame-000010.depth.png", "frame-000020.depth.png"}, poses, "", 0.5)),
        Places({10, 20}));
    EXPECT_EQ(placesOf(matchPoses({"cloud_20.ply"}, poses, "", 0.5)), Places({20}));
    expectHolds(refusal([&] { (void)matchPoses({"cloud_30.ply"}, poses, "", 0.5); }),
                "no pose for cloud_30.ply");
}

// Names -----------------------------------------------------------------------------------

TEST(NaturalOrder, TwoComesBeforeTen) {
    EXPECT_TRUE(naturallyBefore("scan_2.pcd", "scan_10.pcd"));
    EXPECT_FALSE(naturallyBefore("scan_10.pcd", "scan_2.pcd"));
    EXPECT_TRUE(naturallyBefore("a/9", "b/1"));
    EXPECT_TRUE(naturallyBefore("x01", "x1") != naturallyBefore("x1", "x01")) << "an order of all";
    EXPECT_FALSE(naturallyBefore("x1", "x1"));
    EXPECT_TRUE(naturallyBefore("99999999999999999998", "99999999999999999999"));
    EXPECT_TRUE(naturallyBefore("1305.2.png", "1305.10.png"));
}

TEST(NaturalOrder, FramesAndNumbers) {
    EXPECT_EQ(frameName("d/frame-000010.depth.png"), "frame-000010");
    EXPECT_EQ(frameName("1305031102.160407.png"), "1305031102.160407");
    EXPECT_EQ(lastNumber("frame-000010"), "000010");
    EXPECT_EQ(lastNumber("x1305031102.16"), "1305031102.16");
    EXPECT_EQ(lastNumber("none"), "");
}

}  // namespace
