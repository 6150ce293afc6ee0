// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
//
// Recorded poses that are wrong: what moves with them, what stays, and by how much.
#include <gtest/gtest.h>

#include <cmath>

#include "simulation/simulate.h"

namespace {

using namespace akimap::app;
using mrpt::poses::CPose3D;

SimulatedDrive drive(const PoseErrors& errors, uint64_t seed = 1,
                     SensorKind sensor = SensorKind::velodyne) {
    SimulationOptions options;
    options.sensor = sensor, options.moving = sensor == SensorKind::velodyne;
    options.seed = seed, options.pose_errors = errors;
    return simulate(options);
}

mrpt::math::TPoint3D fromRobot(const CPose3D& robot, const std::array<double, 3>& p) {
    return robot.inverseComposePoint(mrpt::math::TPoint3D(p[0], p[1], p[2]));
}

TEST(PoseErrors, MoveRaysAndPosesOfAScanTogether) {
    const SimulatedDrive clean = drive({}), wrong = drive({0.02, 0.01, 0.01, 0.005});
    ASSERT_EQ(clean.scans.size(), wrong.scans.size());
    for (std::size_t i = 0; i < clean.scans.size(); i++) {
        const SimulatedScan &a = clean.scans[i], &b = wrong.scans[i];
        EXPECT_GT(a.robot_pose.distanceTo(b.robot_pose), 1e-3);
        EXPECT_LT(a.robot_pose.distanceTo(wrong.true_trajectory.at(b.time)), 1e-9);
        // While the robot drives too, the recorded trajectory places each packet as the rays are.
        for (const double later : {0.0, 0.03, 0.08}) {
            const CPose3D step = -clean.trajectory.at(a.time) + clean.trajectory.at(a.time + later);
            const CPose3D expected = b.robot_pose + step;
            EXPECT_LT(expected.distanceTo(wrong.trajectory.at(b.time + later)), 1e-6);
        }
        ASSERT_EQ(a.rays.size(), b.rays.size());
        for (std::size_t j = 0; j < a.rays.size(); j++) {
            ASSERT_LT(fromRobot(a.robot_pose, a.rays[j].origin)
                          .distanceTo(fromRobot(b.robot_pose, b.rays[j].origin)),
                      1e-9);
            ASSERT_LT(fromRobot(a.robot_pose, a.rays[j].end)
                          .distanceTo(fromRobot(b.robot_pose, b.rays[j].end)),
                      1e-9);
        }
    }
}

TEST(PoseErrors, LeaveTheTruthAlone) {
    const auto a = drive({}).truth(0.2), b = drive({0.05, 0.05, 0, 0}).truth(0.2);
    EXPECT_TRUE(*a == *b);
    const SimulatedDrive clean = drive({});
    for (std::size_t i = 0; i < clean.trajectory.keyframes().size(); i++)
        EXPECT_EQ(clean.trajectory.keyframes()[i].pose, clean.true_trajectory.keyframes()[i].pose);
}

/** Root mean square of the errors of a scan over many drives, on an axis: position [m], yaw. */
struct Spread {
    double position = 0, angle = 0;
};
/** Of each scan of a drive. */
std::vector<Spread> spreadsOf(const PoseErrors& errors) {
    constexpr int kDrives = 60;
    std::vector<Spread> spreads(12);
    for (int seed = 1; seed <= kDrives; seed++) {
        const SimulatedDrive d = drive(errors, static_cast<uint64_t>(seed), SensorKind::pointcloud);
        for (std::size_t i = 0; i < spreads.size(); i++) {
            const SimulatedScan& scan = d.scans.at(i);
            const CPose3D off = scan.robot_pose - d.true_trajectory.at(scan.time);
            spreads[i].position += off.norm() * off.norm() / 3 / kDrives;
            spreads[i].angle += off.yaw() * off.yaw() / kDrives;
        }
    }
    for (Spread& s : spreads) s = {std::sqrt(s.position), std::sqrt(s.angle)};
    return spreads;
}

TEST(PoseErrors, AreWhiteOrDrift) {
    const auto white = spreadsOf({0.02, 0.01, 0, 0}), drift = spreadsOf({0, 0, 0.02, 0.01});
    for (const std::size_t scan : {0, 9}) {
        EXPECT_NEAR(white[scan].position, 0.02, 0.004);
        EXPECT_NEAR(white[scan].angle, 0.01, 0.003);
    }
    EXPECT_LT(drift[0].position, 1e-9);
    EXPECT_NEAR(drift[1].position, 0.02, 0.004);
    EXPECT_NEAR(drift[9].position, 3 * 0.02, 0.012);  // sqrt(9) steps
    EXPECT_NEAR(drift[9].angle, 3 * 0.01, 0.009);
}

TEST(PoseErrors, AreRefusedBelowZero) {
    EXPECT_THROW(drive({-1, 0, 0, 0}), std::runtime_error);
    EXPECT_THROW(drive({0, NAN, 0, 0}), std::runtime_error);
    EXPECT_THROW(drive({0, 0, -1, 0}), std::runtime_error);
    EXPECT_THROW(drive({0, 0, 0, INFINITY}), std::runtime_error);
}

}  // namespace
