// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
//
// `akimap build` on the data that people have: clouds and depth images with poses. A map is right,
// or one sentence says what is missing.
#include <algorithm>
#include <cstring>

#include "alike.h"
#include "build_fixture.h"

#include <akimap/queries.h>
#include <mrpt/poses/CPose3DQuat.h>

namespace {

using namespace build_tests;

/** What one scan of a box-shaped room of 6 x 4 x 2.5 m sees from a pose: points in its own frame.
 */
std::vector<mrpt::math::TPoint3D> roomFrom(const CPose3D& sensor) {
    std::vector<mrpt::math::TPoint3D> points;
    for (int i = 0; i < 90; i++)
        for (int j = -12; j <= 12; j++) {
            const double a = i * M_PI / 45, e = j * M_PI / 40;
            mrpt::math::TPoint3D d(std::cos(a) * std::cos(e), std::sin(a) * std::cos(e),
                                   std::sin(e));
            const auto g = sensor.rotateVector({d.x, d.y, d.z});
            const double t =
                std::min({g.x > 0 ? (3 - sensor.x()) / g.x : (-3 - sensor.x()) / g.x,
                          g.y > 0 ? (2 - sensor.y()) / g.y : (-2 - sensor.y()) / g.y,
                          g.z > 0 ? (2 - sensor.z()) / g.z : (-.5 - sensor.z()) / g.z});
            points.push_back(d * t);
        }
    return points;
}

CPose3D placeOf(int scan) {
    return CPose3D(0.2 * scan - 1, 0.1 * scan, 0.05 * scan, 0.3 * scan, 0.05 * scan, -0.02 * scan);
}
constexpr int kRooms = 11;  // scan_10 must come behind scan_9

class DataIn : public Build {
 protected:
    void SetUp() override { std::filesystem::create_directory(file("scans")); }

    std::string pcdText(const std::vector<mrpt::math::TPoint3D>& points,
                        const std::string& viewpoint) const {
        std::string text = "FIELDS x y z\nSIZE 8 8 8\nTYPE F F F\nWIDTH " +
                           std::to_string(points.size()) + "\nHEIGHT 1\n" + viewpoint +
                           "DATA ascii\n";
        char line[100];
        for (const auto& p : points) {
            std::snprintf(line, sizeof line, "%.9f %.9f %.9f\n", p.x, p.y, p.z);
            text += line;
        }
        return text;
    }
    /** \param in_map whether the points are in the map frame */
    void writeRooms(const std::function<std::string(int)>& viewpoint, bool in_map = false) const {
        for (int i = 0; i < kRooms; i++) {
            auto points = roomFrom(placeOf(i));
            if (in_map)
                for (auto& p : points) p = placeOf(i).composePoint(p);
            write("scans/scan_" + std::to_string(i) + ".pcd", pcdText(points, viewpoint(i)));
        }
    }
    static std::string none(int) { return ""; }
    static std::string here(int i) {  // where the sensor is, without its rotation
        char line[100];
        std::snprintf(line, sizeof line, "VIEWPOINT %.9f %.9f %.9f 1 0 0 0\n", placeOf(i).x(),
                      placeOf(i).y(), placeOf(i).z());
        return line;
    }
    static std::string pose(int i) {
        const auto q = mrpt::poses::CPose3DQuat(placeOf(i)).quat();
        char line[200];
        std::snprintf(line, sizeof line, "VIEWPOINT %.9f %.9f %.9f %.9f %.9f %.9f %.9f\n",
                      placeOf(i).x(), placeOf(i).y(), placeOf(i).z(), q.r(), q.x(), q.y(), q.z());
        return line;
    }
    std::string kitti() const {
        std::string text;
        for (int i = 0; i < kRooms; i++) {
            const auto m = placeOf(i).getHomogeneousMatrixVal<mrpt::math::CMatrixDouble44>();
            char number[40];
            for (int k = 0; k < 12; k++) {
                std::snprintf(number, sizeof number, "%.12f ", m(k / 4, k % 4));
                text += number;
            }
            text += "\n";
        }
        return write("kitti.txt", text);
    }
    /** The map of the rooms at their poses, made without the program. */
    std::string expectedRooms() const {
        AkiMap map;
        for (int i = 0; i < kRooms; i++) {
            std::vector<akimap::Ray> rays;
            for (const auto& p : roomFrom(placeOf(i))) {
                const auto e = placeOf(i).composePoint(p);
                rays.push_back({{placeOf(i).x(), placeOf(i).y(), placeOf(i).z()}, {e.x, e.y, e.z}});
            }
            map.insertRays(rays);
        }
        map.saveToFile(file("expected.akimap"));
        return file("expected.akimap");
    }
    void expectRooms(const std::string& arguments) const {
        const auto run = build(arguments);
        ASSERT_EQ(run.exit, 0) << arguments << ": " << run.err;
        EXPECT_EQ(run.err, "") << arguments;
        EXPECT_GT(akimap::test::alike(file("m.akimap"), expectedRooms()), 0.999) << arguments;
    }
};

// Frames ----------------------------------------------------------------------------------

TEST_F(DataIn, CloudsInTheMapFrameWithTheirViewpoints) {
    writeRooms(here, true);
    expectRooms(file("scans"));
    expectRooms(file("scans") + " --frame map");
}

TEST_F(DataIn, AMissingViewpointIsRefusedByNameAndNotTakenForZero) {
    writeRooms(none);
    expectRefused(file("scans"), {file("scans/scan_0.pcd") + ": where its sensor stood is missing",
                                  "--poses FILE", "--frame map"});
    expectRefused(file("scans") + " --frame sensor", {"scan_0.pcd: --frame sensor needs --poses"});
    EXPECT_EQ(build(file("scans/scan_0.pcd") + " --frame map").exit, 0);
}

TEST_F(DataIn, ARotatedViewpointIsRefusedOrHeededAsAsked) {
    writeRooms(pose);
    expectRefused(file("scans"),
                  {"scan_1.pcd: its VIEWPOINT has a rotation", "--frame sensor", "--frame map"});
    expectRooms(file("scans") + " --frame sensor");
}

TEST_F(DataIn, TheSameViewpointInAllIsWarnedOf) {
    writeRooms([](int) { return "VIEWPOINT 0 0 0 1 0 0 0\n"; });
    const auto run = build(file("scans"));
    EXPECT_EQ(run.exit, 0);
    EXPECT_TRUE(holds(run.err, "warning: all 11 clouds")) << run.err;
    EXPECT_TRUE(holds(run.err, "--poses FILE")) << run.err;
}

TEST_F(DataIn, PosesAndViewpointsTogetherNeedAFrame) {
    writeRooms(here, true);
    const std::string arguments = file("scans") + " --poses " + kitti();
    expectRefused(arguments, {"scan_0.pcd: it has a VIEWPOINT of its own besides --poses"});
    expectRooms(arguments + " --frame map");
}

// Poses -----------------------------------------------------------------------------------

TEST_F(DataIn, AFolderOfCloudsWithPosesByEveryForm) {
    writeRooms(none);
    expectRooms(file("scans") + " --poses " + kitti());
    std::string tum, g2o, log;
    for (int i = kRooms - 1; i >= 0; i--) {
        const auto p = mrpt::poses::CPose3DQuat(placeOf(i));
        char line[300];
        std::snprintf(line, sizeof line, " %.9f %.9f %.9f %.9f %.9f %.9f %.9f\n", p.x(), p.y(),
                      p.z(), p.quat().x(), p.quat().y(), p.quat().z(), p.quat().r());
        tum += std::to_string(i) + line;
        g2o += "VERTEX_SE3:QUAT " + std::to_string(i) + line;
    }
    expectRooms(file("scans") + " --poses " + write("t.tum", tum));
    expectRooms(file("scans") + " --trajectory " + file("t.tum"));
    expectRooms(file("scans") + " --poses " + write("t.g2o", g2o));
    // A list, in the order in which shells expand *: scan_1, scan_10, scan_2
    expectRooms(file("scans/*.pcd") + " --poses " + kitti());
    expectRefused(file("scans/scan_[0-8].pcd") + " --poses " + kitti(),
                  {"kitti.txt: 11 poses (KITTI poses) for 9 scans"});
}

TEST_F(DataIn, TheExtrinsicIsWhereTheSensorIsOnWhatThePosesAreOf) {
    const CPose3D mount(0.5, -0.2, 1, 90 * M_PI / 180, 0, M_PI);
    for (int i = 0; i < kRooms; i++)
        write("scans/scan_" + std::to_string(i) + ".pcd", pcdText(roomFrom(placeOf(i)), ""));
    std::string text;
    for (int i = 0; i < kRooms; i++) {
        const auto m =
            (placeOf(i) + (-mount)).getHomogeneousMatrixVal<mrpt::math::CMatrixDouble44>();
        char number[40];
        for (int k = 0; k < 12; k++) {
            std::snprintf(number, sizeof number, "%.12f ", m(k / 4, k % 4));
            text += number;
        }
        text += "\n";
    }
    expectRooms(file("scans") + " --poses " + write("body.txt", text) +
                " --extrinsic .5,-.2,1,90,0,180");
    expectRefused(plain("l.rawlog", walls()) + " --extrinsic 0,0,0,0,0,0",
                  {"--extrinsic changes nothing here"});
}

TEST_F(DataIn, AKittiFolder) {
    // The poses of KITTI are its left camera's; calib.txt says where the lidar is in it.
    const CPose3D lidar_in_camera(0.1, -0.08, -0.27, -M_PI / 2, 0, -M_PI / 2);
    std::string poses;
    const auto addRow = [](std::string& text, const CPose3D& pose) {
        const auto m = pose.getHomogeneousMatrixVal<mrpt::math::CMatrixDouble44>();
        char number[40];
        for (int k = 0; k < 12; k++) {
            std::snprintf(number, sizeof number, "%.12e ", m(k / 4, k % 4));
            text += number;
        }
        text += "\n";
    };
    std::filesystem::create_directory(file("velodyne"));
    for (int i = 0; i < kRooms; i++) {
        char name[40];
        std::snprintf(name, sizeof name, "velodyne/%06d.bin", i);
        std::string bytes;
        for (const auto& p : roomFrom(placeOf(i)))
            for (const double v : {p.x, p.y, p.z, 0.5}) {
                const auto f = static_cast<float>(v);
                bytes.append(reinterpret_cast<const char*>(&f), sizeof f);
            }
        write(name, bytes);
        addRow(poses, placeOf(i) + (-lidar_in_camera));
    }
    write("poses.txt", poses);
    std::string calib = "P0: 7 0 0 0 0 7 0 0 0 0 1 0\nTr: ";
    addRow(calib, lidar_in_camera);
    write("calib.txt", calib);
    expectRooms(file("velodyne") + " --poses " + file("poses.txt") + " --extrinsic " +
                file("calib.txt"));
    expectRefused(file("velodyne"), {"000000.bin: where its sensor stood is missing"});
}

TEST_F(DataIn, PointsWithTimesAreTakenFromWhereTheSensorWasThen) {
    // A wall at x = 3, seen in a second while the sensor comes 1 m nearer.
    const auto cloudOf = [](bool moving) {
        std::string text =
            "FIELDS x y z time\nSIZE 4 4 4 4\nTYPE F F F F\nWIDTH 400\nHEIGHT 1\n"
            "DATA ascii\n";
        for (int k = 0; k < 400; k++) {
            const double t = k / 400.;
            text += std::to_string(3 - (moving ? t : 0)) + " " + std::to_string(k % 20 * 0.05) +
                    " " + std::to_string(k / 20 * 0.05) + " " + std::to_string(t) + "\n";
        }
        return text;
    };
    write("scans/100.pcd", cloudOf(true));
    const std::string tum = write("t.tum", "100 0 0 0 0 0 0 1\n101 1 0 0 0 0 0 1\n");
    const auto depthOfWall = [&](const std::string& more) {
        const auto run = build(file("scans") + " --max-gap 2 --poses " + tum + more);
        EXPECT_EQ(run.exit, 0) << run.err;
        double low = 10, high = 0;
        AkiMap::loadFromFile(file("m.akimap"))->forEachCell([&](const akimap::Cell& c) {
            if (c.state.occupancy() < 0.5) return;
            low = std::min(low, c.x), high = std::max(high, c.x);
        });
        return high - low;
    };
    EXPECT_LT(depthOfWall(""), 0.2);
    EXPECT_GT(depthOfWall(" --no-deskew"), 0.7);
}

TEST_F(DataIn, PosesThatDoNotMatchAreWarnedOf) {
    writeRooms(none);
    std::string inverted;
    for (int i = 0; i < kRooms; i++) {
        const auto m = (-placeOf(i)).getHomogeneousMatrixVal<mrpt::math::CMatrixDouble44>();
        char number[40];
        for (int k = 0; k < 12; k++) {
            std::snprintf(number, sizeof number, "%.12f ", m(k / 4, k % 4));
            inverted += number;
        }
        inverted += "\n";
    }
    const auto run = build(file("scans") + " --poses " + write("inverted.txt", inverted));
    EXPECT_EQ(run.exit, 0);
    EXPECT_TRUE(holds(run.err, "warning: the inverses of the poses match better")) << run.err;
}

// Folders and files -----------------------------------------------------------------------

TEST_F(DataIn, FoldersThatAreNoneOfOursAreRefused) {
    expectRefused(file("scans"), {"scans: this is a folder without point clouds"});
    write("scans/a.png", "");
    expectRefused(file("scans"), {"scans: images, not point clouds", "--depth"});
    write("scans/a.pcd", asciiPcd("2 0 1\n", 1));
    write("scans/b.ply", "ply");
    expectRefused(file("scans"), {"scans: point clouds of several kinds", ".pcd", ".ply"});
    expectRefused(write("x.mcap", "?"), {"x.mcap: not a", "rosbags-convert"});
    expectRefused(write("x.rawlg", "?"), {"x.rawlg: not a", "did you mean .rawlog?"});
    expectRefused(write("x.bag", "no bag"), {"x.bag: "});
    write("scans/kitti.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n");
    expectRefused(file("scans/kitti.txt"), {"kitti.txt: where its sensor stood is missing"});
    expectRefused(file("scans/kitti.txt") + " --frame map", {"kitti.txt: line 1", "poses"});
}

TEST_F(DataIn, OptionsThatChangeNothingAreRefused) {
    const std::string log = plain("l.rawlog", walls());
    expectRefused(log + " --frame map", {"--frame changes nothing here"});
    expectRefused(log + " --times " + write("times.txt", "1\n"), {"--times changes nothing here"});
    expectRefused(log + " --poses " + kitti(), {"kitti.txt: KITTI poses have no times"});
}

// Depth images ----------------------------------------------------------------------------

/** 64 x 48 pixels, all at 2 m but for a corner without a depth. */
void writeDepth(const std::string& name, uint16_t steps) {
    mrpt::img::CImage image(64, 48, mrpt::img::CH_GRAY);
    image.resize(64, 48, mrpt::img::CH_GRAY, mrpt::img::PixelDepth::D16U);
    for (unsigned y = 0; y < 48; y++)
        for (unsigned x = 0; x < 64; x++)
            image.ptrLine<uint16_t>(y)[x] = x < 4 ? uint16_t{0} : x < 8 ? uint16_t{65535} : steps;
    ASSERT_TRUE(image.saveToFile(name));
}

class DepthIn : public DataIn {
 protected:
    // z of the camera looks along the map's x, its x along the map's -y.
    static constexpr const char* kAhead = "0 0 1 1\n-1 0 0 2\n0 -1 0 3\n0 0 0 1\n";
    static constexpr const char* kCamera = " --intrinsics 60,60,32,24";

    void expectWallAt(double x, const std::string& arguments) const {
        const auto run = build(arguments);
        ASSERT_EQ(run.exit, 0) << run.err;
        EXPECT_EQ(json()["points"], 56 * 48) << arguments;
        const auto map = AkiMap::loadFromFile(file("m.akimap"));
        EXPECT_GT(map->occupancy(x, 2.01, 3.01).value_or(0), 0.5) << arguments;
        EXPECT_LT(map->occupancy(x - 0.5, 2.01, 3.01).value_or(1), 0.5) << arguments;
        EXPECT_GT(map->occupancy(x, 1.5, 3.01).value_or(0), 0.5) << "right of the camera";
        EXPECT_FALSE(map->occupancy(x, 3.05, 3.01)) << "pixels without a depth";
    }
};

TEST_F(DepthIn, AFolderOfImagesByOneCommand) {
    writeDepth(file("scans/frame-000001.depth.png"), 2010);
    write("scans/frame-000001.pose.txt", kAhead);
    const std::string images = " --depth " + file("scans");
    expectWallAt(3.01, images + kCamera + " --poses " + file("scans"));
    expectWallAt(3.01, images + " --poses " + file("scans") + " --intrinsics " +
                           write("k.txt", "60 0 32\n0 60 24\n0 0 1\n"));
    expectWallAt(3.01, images + " --poses " + file("scans") + " --intrinsics " +
                           write("k.json", "{\"intrinsic_matrix\": [60,0,0, 0,60,0, 32,24,1]}"));
    expectWallAt(3.01,
                 images + kCamera + " --poses " + write("o.log", std::string("0 0 1\n") + kAhead));
    writeDepth(file("scans/frame-000001.depth.png"), 10050);
    expectWallAt(3.01, images + kCamera + " --poses " + file("scans") + " --depth-scale 5000");
    expectWallAt(3.01, images + kCamera + " --poses " + file("scans") + " --depth-scale 0.0002");
}

TEST_F(DepthIn, AsTumRgbdHasThem) {
    std::filesystem::create_directory(file("depth"));
    writeDepth(file("depth/1305031102.160407.png"), 10050);
    writeDepth(file("depth/1305031102.360407.png"), 10050);
    const std::string tum = write("groundtruth.txt",
                                  "# timestamp tx ty tz qx qy qz qw\n"
                                  "1305031102.1 1 2 3 -.5 .5 -.5 .5\n"
                                  "1305031102.2 1 2 3 -.5 .5 -.5 .5\n");
    const std::string list = write("depth.txt",
                                   "# depth maps\n1305031102.160407 depth/1305031102.160407.png\n"
                                   "1305031102.360407 depth/1305031102.360407.png\n");
    for (const std::string& images : {list, file("depth")}) {
        expectWallAt(3.01, "--depth " + images + kCamera + " --depth-scale 5000 --poses " + tum);
        EXPECT_EQ(json()["skipped_scans_trajectory"], 1) << "the second is behind the last pose";
    }
}

TEST_F(DepthIn, WhatIsMissingIsSaid) {
    writeDepth(file("scans/1.png"), 2000);
    writeDepth(file("scans/2.png"), 2000);
    const std::string images = "--depth " + file("scans");
    expectRefused(images, {"--depth needs --intrinsics"});
    expectRefused(images + kCamera, {"2 depth images, and nothing tells where", "--poses"});
    expectRefused(images + " --intrinsics 60,60,32", {"--intrinsics: expected fx,fy,cx,cy"});
    expectRefused(images + " --intrinsics " + file("none"), {"--intrinsics: " + file("none")});
    expectRefused(images + " --intrinsics 60,60,320,240 --poses " +
                      write("p.log", std::string("0 0 1\n") + kAhead + "1 1 2\n" + kAhead),
                  {"scans/1.png: an image of 64 x 48"});
    expectRefused(images + kCamera + " --depth-scale 0", {"--depth-scale must be"});
    mrpt::img::CImage eight_bits(64, 48, mrpt::img::CH_GRAY);
    ASSERT_TRUE(eight_bits.saveToFile(file("scans/1.png")));
    expectRefused(images + kCamera + " --poses " + file("p.log"),
                  {"scans/1.png: not a grey image of 16 bits"});
}

// Recordings ------------------------------------------------------------------------------

std::string dataFolder(const std::string& name) {
    const char* data = std::getenv("AKIMAP_DATA");
    const std::string folder = std::string(data ? data : "") + "/" + name;
    return std::filesystem::is_directory(folder) ? folder : "";
}

TEST_F(DataIn, TheDenseLidarByKittiPosesAndByTum) {
    const std::string scans = dataFolder("lidar_dense");
    if (scans.empty()) GTEST_SKIP() << "no lidar_dense/ in AKIMAP_DATA";
    const std::string build = "build '" + scans + "' --poses '" + scans;
    ASSERT_EQ(runProgram(build + "/poses_kitti.txt' -o " + file("k.akimap")).exit, 0);
    ASSERT_EQ(runProgram(build + "/trajectory.tum' -o " + file("t.akimap")).exit, 0);
    EXPECT_GE(akimap::test::alike(file("k.akimap"), file("t.akimap")), 0.999);
}

TEST_F(DataIn, TheOfficeByOneCommand) {
    const std::string office = dataFolder("rgbd_office");
    if (office.empty()) GTEST_SKIP() << "no rgbd_office/ in AKIMAP_DATA";
    const auto run = build("--depth '" + office + "' --intrinsics '" + office +
                           "/camera-intrinsics.txt' --poses '" + office + "'");
    EXPECT_EQ(run.exit, 0) << run.err;
    EXPECT_EQ(json()["scans"], 50);
}

}  // namespace
