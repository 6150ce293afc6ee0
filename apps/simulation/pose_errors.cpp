// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "simulation/pose_errors.h"

#include <array>
#include <cmath>

#include "simulation/Random.h"

namespace akimap::app {

using mrpt::poses::CPose3D;

namespace {

CPose3D randomPose(double position, double angle, Random& random) {
    const double x = random.normal(position), y = random.normal(position);
    const double z = random.normal(position), yaw = random.normal(angle);
    const double pitch = random.normal(angle), roll = random.normal(angle);
    return {x, y, z, yaw, pitch, roll};
}

/** What turns what is true at each scan into what is recorded, in the map frame. */
std::vector<CPose3D> displacements(const SimulatedDrive& drive, const PoseErrors& errors,
                                   uint64_t seed) {
    Random random(seed, 5);
    CPose3D drift;
    std::vector<CPose3D> all;
    for (const SimulatedScan& scan : drive.scans) {
        if (!all.empty())
            drift = drift + randomPose(errors.drift_position, errors.drift_angle, random);
        const CPose3D wrong =
            scan.robot_pose + drift + randomPose(errors.position, errors.angle, random);
        all.push_back(wrong + (-scan.robot_pose));
    }
    return all;
}

std::array<double, 3> moved(const CPose3D& by, const std::array<double, 3>& p) {
    std::array<double, 3> q{};
    by.composePoint(p[0], p[1], p[2], q[0], q[1], q[2]);
    return q;
}

std::size_t nearestScan(const std::vector<SimulatedScan>& scans, double time) {
    std::size_t nearest = 0;
    for (std::size_t i = 1; i < scans.size(); i++)
        if (std::abs(scans[i].time - time) < std::abs(scans[nearest].time - time)) nearest = i;
    return nearest;
}

}  // namespace

void misplace(SimulatedDrive& drive, const PoseErrors& errors, uint64_t seed) {
    const std::vector<CPose3D> by = displacements(drive, errors, seed);
    drive.trajectory = Trajectory();
    for (const TimedPose& at : drive.true_trajectory.keyframes())
        drive.trajectory.add(at.time, by[nearestScan(drive.scans, at.time)] + at.pose);
    for (std::size_t i = 0; i < drive.scans.size(); i++) {
        drive.scans[i].robot_pose = by[i] + drive.scans[i].robot_pose;
        for (Ray& ray : drive.scans[i].rays)
            ray.origin = moved(by[i], ray.origin), ray.end = moved(by[i], ray.end);
    }
}

}  // namespace akimap::app
