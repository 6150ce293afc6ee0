// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
//
// ROS 1 bags as input: their scans, and where tf, odometry, poses or a trajectory put them.
#include <geometry_msgs/PoseStamped.h>
#include <nav_msgs/Odometry.h>
#include <rosbag/bag.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/PointCloud2.h>
#include <tf2_msgs/TFMessage.h>

#include <mrpt/poses/CPose3DQuat.h>

#include <cstring>

#include "build_fixture.h"

namespace {

using namespace build_tests;

ros::Time stampOf(int scan, double later = 0) {
    return ros::Time(timeOf(scan) + later);
}

template <class Message>
Message headed(int scan, const std::string& frame) {
    Message message;
    message.header.stamp = stampOf(scan);
    message.header.frame_id = frame;
    return message;
}

class Bag : public Build {
 protected:
    void SetUp() override { bag.open(file("b.bag"), rosbag::bagmode::Write); }
    std::string close() {
        bag.close();
        return file("b.bag");
    }

    /** What wall() sees, in its sensor's frame, or where the robot's pose puts it. */
    void writeCloud(int scan, const std::string& frame, const CPose3D& moved = CPose3D(),
                    const std::string& topic = "/points") {
        auto cloud = headed<sensor_msgs::PointCloud2>(scan, frame);
        const auto seen = wall(scan);
        const auto& points = *seen->pointcloud;
        const char* const names[] = {"x", "y", "z"};
        cloud.point_step = 16;
        for (uint32_t i = 0; i < 3; i++) {
            sensor_msgs::PointField field;
            field.name = names[i];
            field.offset = 4 * i;
            field.datatype = sensor_msgs::PointField::FLOAT32;
            field.count = 1;
            cloud.fields.push_back(field);
        }
        cloud.height = 1;
        cloud.width = static_cast<uint32_t>(points.size());
        cloud.row_step = cloud.width * cloud.point_step;
        cloud.data.resize(cloud.row_step);
        for (std::size_t i = 0; i < points.size(); i++) {
            mrpt::math::TPoint3D p;
            points.getPoint(i, p.x, p.y, p.z);
            p = moved.composePoint(p);
            const float xyz[3] = {static_cast<float>(p.x), static_cast<float>(p.y),
                                  static_cast<float>(p.z)};
            std::memcpy(&cloud.data[16 * i], xyz, sizeof xyz);
        }
        bag.write(topic, stampOf(scan), cloud);
    }
    void writeTransform(int scan, const std::string& parent, const std::string& child,
                        const CPose3D& pose, const std::string& topic = "/tf") {
        auto t = headed<geometry_msgs::TransformStamped>(scan, parent);
        t.child_frame_id = child;
        set(t.transform.translation, t.transform.rotation, pose);
        tf2_msgs::TFMessage message;
        message.transforms.push_back(t);
        bag.write(topic, stampOf(scan), message);
    }
    template <class Translation, class Rotation>
    static void set(Translation& translation, Rotation& rotation, const CPose3D& pose) {
        const mrpt::poses::CPose3DQuat q(pose);
        translation.x = q.x(), translation.y = q.y(), translation.z = q.z();
        rotation.w = q.quat().r(), rotation.x = q.quat().x();
        rotation.y = q.quat().y(), rotation.z = q.quat().z();
    }
    /** The same map as that of the walls, up to float rounding: rays run along faces of cells. */
    void expectWalls(const std::string& arguments) {
        const auto run = build(arguments);
        ASSERT_EQ(run.exit, 0) << run.err;
        EXPECT_EQ(run.err, "");
        EXPECT_EQ(json()["scans"], kScans);
        EXPECT_EQ(json()["points"], kScans * 17 * 17);
        (void)expectedMap();
        const auto expected = AkiMap::loadFromFile(file("expected.akimap"));
        std::size_t cells = 0, same = 0;
        AkiMap::loadFromFile(file("m.akimap"))->forEachCell([&](const akimap::Cell& c) {
            cells++;
            const auto there = expected->cell(c.x, c.y, c.z);
            same += there && std::abs(there->occupancy() - c.state.occupancy()) < 0.1;
        });
        EXPECT_GT(static_cast<double>(same), 0.99 * static_cast<double>(cells));
        EXPECT_NEAR(static_cast<double>(cells), static_cast<double>(expected->cellCount()),
                    0.01 * static_cast<double>(cells));
    }
    static CPose3D mount() { return CPose3D(0.25, 0, 1, 0, 0, 0); }

    rosbag::Bag bag;
};

TEST_F(Bag, CloudsPlacedByTf) {
    writeTransform(0, "base_link", "/lidar", mount(), "/tf_static");
    for (int i = 0; i < kScans; i += 2) writeTransform(i, "odom", "base_link", poseOf(i));
    for (int i = 0; i < kScans; i++) writeCloud(i, "lidar");
    expectWalls(close());
}

TEST_F(Bag, CloudsPlacedByOdometryAndATrajectory) {
    writeTransform(0, "base_link", "lidar", mount(), "/tf_static");
    for (int i = 0; i < kScans; i++) {
        auto odometry = headed<nav_msgs::Odometry>(i, "odom");
        odometry.child_frame_id = "base_link";
        set(odometry.pose.pose.position, odometry.pose.pose.orientation, poseOf(i));
        bag.write("/odom", stampOf(i), odometry);
        writeCloud(i, "lidar");
    }
    expectWalls(close());
    expectWalls(file("b.bag") + " --poses " + trajectory());
    expectRefused(file("b.bag") + " --poses " + write("old.tum", "1 2 3 4 0 0 0 1\n"),
                  {"old.tum: covers no scan"});
}

TEST_F(Bag, WithoutTfOfTheSensorTheExtrinsicTells) {
    for (int i = 0; i < kScans; i++) writeCloud(i, "lidar");
    expectWalls(close() + " --extrinsic .25,0,1,0,0,0 --poses " + trajectory());
    const auto run = build(file("b.bag"));
    EXPECT_EQ(run.exit, 0);
    EXPECT_TRUE(holds(run.err, "no tf, odometry or poses in it")) << run.err;
}

TEST_F(Bag, CloudsInTheMapFrameBegunAtThePosesOfATopic) {
    for (int i = 0; i < kScans; i++) {
        writeCloud(i, "/map", poseOf(i) + mount());
        auto pose = headed<geometry_msgs::PoseStamped>(i, "/map");
        pose.header.stamp = stampOf(i, 0.04);  // a little later, each
        set(pose.pose.position, pose.pose.orientation, poseOf(i) + mount());
        bag.write("/robot_pose", stampOf(i, 0.04), pose);
    }
    expectWalls(close());
}

TEST_F(Bag, LaserScansAndDepthImages) {
    for (int i = 0; i < kScans; i++) writeTransform(i, "odom", "base", poseOf(i));
    auto laser = headed<sensor_msgs::LaserScan>(1, "base");
    laser.angle_min = 0, laser.angle_max = 1.5f, laser.angle_increment = 0.01f;
    laser.range_min = 0.1f, laser.range_max = 20;
    laser.ranges.assign(151, 2.01f);
    laser.ranges[3] = std::nanf(""), laser.ranges[4] = 30, laser.ranges[5] = 0;
    bag.write("/scan", stampOf(1), laser);
    auto camera = headed<sensor_msgs::CameraInfo>(2, "base");
    camera.K = {30, 0, 16, 0, 30, 12, 0, 0, 1};
    bag.write("/depth/camera_info", stampOf(2), camera);
    auto image = headed<sensor_msgs::Image>(2, "base");
    image.width = 32, image.height = 24, image.step = 64, image.encoding = "16UC1";
    image.data.assign(64 * 24, 0);
    for (std::size_t i = 0; i < 32 * 24; i++)
        image.data[2 * i] = 0xd0, image.data[2 * i + 1] = 0x07;
    bag.write("/depth/image_raw", stampOf(2), image);
    const auto run = build(close());
    ASSERT_EQ(run.exit, 0) << run.err;
    EXPECT_TRUE(holds(run.err, "/depth/image_raw, /scan; --only TOPIC")) << run.err;
    EXPECT_EQ(json()["points"], 148 + 32 * 24);
    const auto map = AkiMap::loadFromFile(file("m.akimap"));
    const double x = poseOf(1).x();  // the laser begins ahead and turns left
    EXPECT_GT(map->occupancy(x + 2.01 * std::cos(1.5), 2.01 * std::sin(1.5), 0.01).value_or(0), .5);
    EXPECT_FALSE(map->occupancy(x + 2.01 * std::cos(0.8), -2.01 * std::sin(0.8), 0.01));
    // The camera looks along z of its frame.
    EXPECT_GT(map->occupancy(poseOf(2).x() + 0.01, 0.01, 2.01).value_or(0), 0.5);
    EXPECT_EQ(build(file("b.bag") + " --only /scan").exit, 0);
    EXPECT_EQ(json()["points"], 148);
    EXPECT_EQ(json()["skipped_scans_label"], 1);
}

TEST_F(Bag, ScansOutsideOfTfAreSkippedAndCounted) {
    for (int i = 0; i < 3; i++) writeTransform(i, "odom", "lidar", poseOf(i) + mount());
    for (int i = 0; i < kScans; i++) writeCloud(i, "lidar");
    ASSERT_EQ(build(close()).exit, 0);
    EXPECT_EQ(json()["scans"], 3);
    EXPECT_EQ(json()["skipped_scans_trajectory"], 2);
}

TEST_F(Bag, DamagedOnesAreRefused) {
    for (int i = 0; i < kScans; i++) writeCloud(i, "lidar");
    const std::string whole = readText(close());
    expectRefused(write("cut.bag", whole.substr(0, whole.size() / 2)), {"cut.bag: "});
    expectRefused(write("none.bag", "no bag at all"), {"none.bag: no ROS 1 bag"});
    expectRefused(write("empty.bag", ""), {"empty.bag: "});
    expectRefused(file("missing.bag"), {"missing.bag: no such file"});
    std::string flipped = whole;
    for (std::size_t i = whole.size() / 3; i < whole.size() / 3 + 400; i++) flipped[i] = '\xff';
    const auto run = build(write("flipped.bag", flipped));
    EXPECT_LT(run.exit, 128) << run.err;
}

TEST_F(Bag, ConvertsToARawlog) {
    for (int i = 0; i < kScans; i++) writeTransform(i, "odom", "lidar", poseOf(i) + mount());
    for (int i = 0; i < kScans; i++) writeCloud(i, "lidar");
    ASSERT_EQ(runProgram("convert " + close() + " -o " + file("o.rawlog")).exit, 0);
    expectWalls(file("o.rawlog"));
}

TEST_F(Bag, TheProgramNamesItsReader) {
    bag.close();
    EXPECT_TRUE(holds(runProgram("--version").out, "ROS 1 bags: by librosbag_storage"));
}

}  // namespace
