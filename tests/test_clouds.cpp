// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
//
// Clouds of every format, and which points a scan has where.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "input/clouds/Cloud.h"
#include "run_program.h"

namespace {

using namespace akimap::app;
using Point = std::array<double, 3>;

template <class T>
void append(std::string& bytes, T value, bool big_endian = false) {
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    if (big_endian) std::reverse(raw, raw + sizeof value);
    bytes.append(raw, sizeof value);
}

class Clouds : public ::testing::Test {
 protected:
    Cloud read(const std::string& name, const std::string& bytes) const {
        writeText(folder.file(name), bytes);
        (void)peekCloud(folder.file(name));
        return readCloud(folder.file(name));
    }
    std::string refusal(const std::string& name, const std::string& bytes) const {
        try {
            (void)read(name, bytes);
        } catch (const std::runtime_error& e) {
            return e.what();
        }
        return "nothing thrown";
    }
    void expectRefused(const std::string& name, const std::string& bytes,
                       const std::string& part) const {
        const std::string why = refusal(name, bytes);
        EXPECT_NE(why.find(folder.file(name) + ": " + part), std::string::npos) << why;
    }
    static void expectTwo(const Cloud& cloud) {
        ASSERT_EQ(cloud.points.size(), 2u);
        EXPECT_EQ(cloud.points[0], (Point{1.5, -2.25, 3}));
        EXPECT_EQ(cloud.points[1], (Point{0.125, 1024, -4}));
    }
    TemporaryFolder folder;
};

std::string plyHeader(const std::string& format, const std::string& more = "") {
    return "ply\nformat " + format +
           " 1.0\ncomment by hand\nelement vertex 2\nproperty uchar pad\n"
           "property double x\nproperty float y\nproperty float z\nproperty uint t\n" +
           more + "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
}

TEST_F(Clouds, PlyInText) {
    const Cloud cloud =
        read("a.PLY", plyHeader("ascii") + "7 1.5 -2.25 3 1000\n7 .125 1024 -4 2000000\n3 0 1 2\n");
    expectTwo(cloud);
    ASSERT_EQ(cloud.time.size(), 2u);
    EXPECT_NEAR(cloud.time[1], 2e-3, 1e-12) << "whole numbers are nanoseconds";
    EXPECT_FALSE(cloud.viewpoint);
}

TEST_F(Clouds, PlyInBinaryOfEitherOrder) {
    for (const bool big : {false, true}) {
        std::string bytes = plyHeader(big ? "binary_big_endian" : "binary_little_endian");
        const double points[2][3] = {{1.5, -2.25, 3}, {0.125, 1024, -4}};
        for (const auto& p : points) {
            bytes += '\7';
            append(bytes, p[0], big);
            append(bytes, static_cast<float>(p[1]), big);
            append(bytes, static_cast<float>(p[2]), big);
            append(bytes, uint32_t{5}, big);
        }
        expectTwo(read("b.ply", bytes + "face"));
    }
}

TEST_F(Clouds, DamagedPlyIsRefused) {
    expectRefused("c.ply", "no ply\n", "line 1: not a PLY file");
    expectRefused("c.ply", "ply\nformat ascii 1.0\n", "line 3: no end_header");
    expectRefused("c.ply", plyHeader("ascii") + "7 1.5 -2.25 3 1000\n",
                  "line 14: the file ends after 1 of 2 points");
    expectRefused("c.ply", plyHeader("ascii", "property list uchar int more\n"), "line 10: ");
    expectRefused("c.ply", plyHeader("ascii") + "7 1.5 -2.25 3 1000\n7 one 1024 -4 20000\n",
                  "line 14: 'one' is not a number");
    expectRefused("c.ply",
                  "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nend_header\n",
                  "no field 'y'");
}

TEST_F(Clouds, KittiIsFourFloatsAPoint) {
    std::string bytes;
    for (const float v : {1.5f, -2.25f, 3.f, 0.5f, 0.125f, 1024.f, -4.f, 0.75f}) append(bytes, v);
    const Cloud cloud = read("000000.bin", bytes);
    expectTwo(cloud);
    EXPECT_EQ(cloud.intensity, (std::vector<float>{0.5f, 0.75f}));
    expectRefused("000000.bin", bytes + "1234", "not KITTI's x y z intensity floats");
}

TEST_F(Clouds, TextOfAnyKind) {
    expectTwo(read("t.txt", "# x y z\n1.5 -2.25 3\n\n.125 1024 -4\n"));
    expectTwo(read("t.csv", "intensity,z,y,\"x\"\n9,3,-2.25,1.5\r\n8,-4,1024,.125\r\n"));
    const Cloud cloud = read("t.xyz", "1.5; -2.25; 3; 7\n.125; 1024; -4; 8\n");
    expectTwo(cloud);
    EXPECT_EQ(cloud.intensity, (std::vector<float>{7, 8}));
}

TEST_F(Clouds, TextThatIsNoCloudIsRefused) {
    expectRefused("t.txt", "1 2 3\n4 5\n", "line 2: expected 3 numbers and found 2");
    expectRefused("t.txt", "1 2 3\n4 5 six\n", "line 2: 'six'");
    expectRefused("t.csv", "a,b,c\n1,2,3\n", "line 1: no field 'x'");
    // Poses where points belong
    expectRefused("t.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n", "line 1: expected x y z and found 12");
    expectRefused("t.txt", "1 0 0 0 0 0 0 1\n", "line 1: expected x y z and found 8");
    expectRefused("t.txt", "1 0 0 5\n0 1 0 6\n0 0 1 7\n0 0 0 1\n", "a pose of 4 x 4 numbers");
}

TEST_F(Clouds, PcdKeepsIntensitiesTimesAndViewpoint) {
    const Cloud cloud =
        read("r.pcd",
             "FIELDS x y z intensity ring time\nSIZE 4 4 4 4 2 4\nTYPE F F F F U F\n"
             "WIDTH 1\nHEIGHT 1\nVIEWPOINT 1 2 3 0 0 0 1\nDATA ascii\n"
             "1 2 3 40 15 0.05\n");
    EXPECT_EQ(cloud.intensity.at(0), 40);
    EXPECT_NEAR(cloud.time.at(0), 0.05, 1e-6);
    ASSERT_TRUE(cloud.viewpoint);
    EXPECT_TRUE(cloud.viewpoint->isRotated());
    EXPECT_EQ(cloud.viewpoint->translation, (Point{1, 2, 3}));
}

}  // namespace
