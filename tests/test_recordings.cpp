// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
// The recordings that the benchmark reads, and the script that lays them out.
#include "recordings.h"

#include <gtest/gtest.h>
#include <mrpt/img/CImage.h>

#include <algorithm>
#include <filesystem>

#include "run_program.h"

using namespace akimap;
using namespace akimap::bench;

namespace {

constexpr const char* kCamera = "100 0 4\n0 200 4\n0 0 1\n";
/** At (1, 2, 3) in the map; its z looks along the map's x, its x along the map's -y. */
constexpr const char* kAhead = "0 0 1 1\n-1 0 0 2\n0 -1 0 3\n0 0 0 1\n";

/** An image of 9 x 5 steps of 1 mm, whose every fourth pixels are given, row by row. */
void writeDepth(const std::string& file, const std::array<uint16_t, 6>& steps) {
    mrpt::img::CImage image(9, 5, mrpt::img::CH_GRAY);
    image.resize(9, 5, mrpt::img::CH_GRAY, mrpt::img::PixelDepth::D16U);
    for (unsigned y = 0; y < 5; y++)
        for (unsigned x = 0; x < 9; x++)
            image.ptrLine<uint16_t>(y)[x] =
                x % 4 == 0 && y % 4 == 0 ? steps[x / 4 + 3 * (y / 4)] : uint16_t{777};
    ASSERT_TRUE(image.saveToFile(file));
}

void writeFrame(const TemporaryFolder& folder) {
    writeText(folder.file("camera-intrinsics.txt"), kCamera);
    writeText(folder.file("frame-000010.pose.txt"), kAhead);
    writeDepth(folder.file("frame-000010.depth.png"), {2000, 0, 65535, 300, 1000, 301});
}

std::string messageOf(const std::function<void()>& act) {
    try {
        act();
    } catch (const std::runtime_error& e) {
        return e.what();
    }
    return "";
}

void expectPoint(const std::array<double, 3>& p, double x, double y, double z) {
    EXPECT_NEAR(p[0], x, 1e-9);
    EXPECT_NEAR(p[1], y, 1e-9);
    EXPECT_NEAR(p[2], z, 1e-9);
}

TEST(Recordings, DepthFramesComeInTheMapFrame) {
    const TemporaryFolder folder;
    writeFrame(folder);
    const auto frames = depthFrames(folder.path().string());
    ASSERT_EQ(frames.size(), 1u);
    const auto& rays = frames[0].rays;
    ASSERT_EQ(rays.size(), 3u) << "0, 65535 and 0.3 m are no depths";
    for (const Ray& ray : rays) expectPoint(ray.origin, 1, 2, 3);
    expectPoint(rays[0].end, 1 + 2, 2 + 2 * 4 / 100., 3 + 2 * 4 / 200.);  // pixel (0, 0)
    expectPoint(rays[1].end, 1 + 1, 2, 3);                                // pixel (4, 4)
    expectPoint(rays[2].end, 1 + 0.301, 2 - 0.301 * 4 / 100, 3);          // pixel (8, 4)
}

TEST(Recordings, DamagedFramesAreNamed) {
    const TemporaryFolder folder;
    EXPECT_TRUE(depthFrames(folder.file("nowhere")).empty());
    writeFrame(folder);
    const auto message = [&] {
        return messageOf([&] { (void)depthFrames(folder.path().string()); });
    };
    writeText(folder.file("frame-000010.pose.txt"), "0 0 1 1\n-1 0");
    EXPECT_EQ(message(),
              folder.file("frame-000010.pose.txt") + ": no rows of 16 numbers, but 6 numbers");
    writeText(folder.file("frame-000010.pose.txt"), std::string(kAhead) + "x");
    EXPECT_EQ(message(), folder.file("frame-000010.pose.txt") + ": not a number after the 16th");
    std::filesystem::remove(folder.file("frame-000010.pose.txt"));
    EXPECT_EQ(message(), folder.file("frame-000010.pose.txt") + ": can't be read");
    mrpt::img::CImage eight_bits(9, 5, mrpt::img::CH_GRAY);
    ASSERT_TRUE(eight_bits.saveToFile(folder.file("frame-000010.depth.png")));
    EXPECT_EQ(message(), folder.file("frame-000010.depth.png") + ": no grey image of 16 bits");
}

TEST(Recordings, CloudsAreMovedByTheirPoses) {
    const TemporaryFolder folder;
    const std::string head =
        "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 1\nHEIGHT 1\n"
        "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS 1\nDATA ascii\n";
    writeText(folder.file("scan_01.pcd"), head + "1 0 0\n");
    writeText(folder.file("scan_02.pcd"), head + "0 2 0\n");
    writeText(folder.file("poses_kitti.txt"),
              "1 0 0 5 0 1 0 6 0 0 1 7\n0 -1 0 0 1 0 0 0 0 0 1 1\n");
    const auto scans = posedClouds(folder.path().string());
    ASSERT_EQ(scans.size(), 2u);
    expectPoint(scans[0].rays.at(0).origin, 5, 6, 7);
    expectPoint(scans[0].rays.at(0).end, 6, 6, 7);
    expectPoint(scans[1].rays.at(0).end, -2, 0, 1);
    const auto higher = raised(raysOf(scans), 0.3);
    expectPoint(higher[0].at(0).origin, 5, 6, 7.3);
    expectPoint(higher[0].at(0).end, 6, 6, 7);
    writeText(folder.file("poses_kitti.txt"), "1 0 0 5 0 1 0 6 0 0 1 7\n");
    EXPECT_EQ(messageOf([&] { (void)posedClouds(folder.path().string()); }),
              folder.file("poses_kitti.txt") + ": 1 poses for 2 scans");
}

TEST(Recordings, OfAkimapData) {
    const auto office = depthFrames(dataFolder("rgbd_office"));
    const auto lidar = posedClouds(dataFolder("lidar_dense"));
    if (office.empty() || lidar.empty())
        GTEST_SKIP() << "no rgbd_office or lidar_dense in AKIMAP_DATA";
    EXPECT_EQ(office.size(), 50u);
    EXPECT_EQ(lidar.size(), 15u);
    EXPECT_EQ(lidar[0].rays.size(), 73452u);
    EXPECT_GT(office[0].rays.size(), 15000u);
    EXPECT_LE(office[0].rays.size(), 160u * 120u);
    EXPECT_NEAR(office[0].sensor.x(), -0.34045634, 1e-8);
}

/** Files as they lie in a repository of others, as far as the script wants them. */
void layOutClones(const std::filesystem::path& clones) {
    const auto file = [&](const std::string& name, const std::string& text) {
        const auto path = clones / name;
        std::filesystem::create_directories(path.parent_path());
        writeText(path.string(), text);
    };
    for (const char* repository : {"la3dm", "BALM", "tsdf-fusion-python"})
        file(std::string(repository) + "/LICENSE", repository);
    for (int n = 1; n <= 12; n++)
        file("la3dm/data/sim_structured/sim_structured_" + std::to_string(n) + ".pcd", "s");
    for (int n = 1; n <= 60; n++)
        file("la3dm/data/sim_structured_long_term/sim_structured_long_term_" + std::to_string(n) +
                 ".pcd",
             "l");
    std::string poses;
    for (int n = 0; n <= 60; n++) {
        const std::string number = std::to_string(n);
        file("BALM/datas/benchmark_realworld/full" + number + ".pcd", number);
        poses += number + ",0,0,1,\n0,1,0,2,\n0,0,1,3,\n0,0,0,1630577758.5,\n";
    }
    file("BALM/datas/benchmark_realworld/alidarPose.csv", poses);
    file("tsdf-fusion-python/data/camera-intrinsics.txt", kCamera);
    for (int n = 0; n < 500; n += 5) {
        std::string number = std::to_string(n);
        number.insert(0, 6 - number.size(), '0');
        file("tsdf-fusion-python/data/frame-" + number + ".depth.png", number);
        file("tsdf-fusion-python/data/frame-" + number + ".pose.txt", kAhead);
    }
}

TEST(Recordings, DataShLaysOutClones) {
    const TemporaryFolder folder;
    const std::filesystem::path clones = folder.path() / "clones", data = folder.path() / "data";
    layOutClones(clones);
    const std::string command = std::string("'") + AKIMAP_SOURCE_DIR + "/benchmarks/data.sh' '" +
                                data.string() + "' '" + clones.string() + "'";
    const ::Run run = runCommand(command);
    ASSERT_EQ(run.exit, 0) << run.err;
    EXPECT_EQ(readText(data / "lidar_dense/scan_01.pcd"), "0");
    EXPECT_EQ(readText(data / "lidar_dense/scan_15.pcd"), "56");
    const std::string poses = readText(data / "lidar_dense/poses_kitti.txt");
    EXPECT_EQ(std::count(poses.begin(), poses.end(), '\n'), 15);
    EXPECT_EQ(poses.substr(0, poses.find("8 0 0 1")),
              "0 0 0 1 0 1 0 2 0 0 1 3\n4 0 0 1 0 1 0 2 0 0 1 3\n");
    EXPECT_EQ(readText(data / "rgbd_office/frame-000490.depth.png"), "000490");
    EXPECT_FALSE(std::filesystem::exists(data / "rgbd_office/frame-000005.depth.png"));
    EXPECT_EQ(readText(data / "la3dm/sim_structured_long_term/sim_structured_long_term_60.pcd"),
              "l");
    EXPECT_EQ(readText(data / "rgbd_office/LICENSE"), "tsdf-fusion-python");

    const auto missing = clones / "BALM/datas/benchmark_realworld/full8.pcd";
    std::filesystem::remove(missing);
    const ::Run refused = runCommand(command);
    EXPECT_NE(refused.exit, 0);
    EXPECT_EQ(refused.err, "data.sh: " + missing.string() + " is missing\n");
    EXPECT_EQ(refused.out, "");
}

}  // namespace
