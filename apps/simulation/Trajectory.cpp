// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "simulation/Trajectory.h"

#include <mrpt/core/Clock.h>

#include <cmath>
#include <stdexcept>

#include "simulation/Random.h"

namespace akimap::app {

using mrpt::poses::CPose3D;

namespace {

constexpr double kFirstScan = 1.7e9 + 0.5;  // [s since 1970], a fixed one: same seed, same files
constexpr double kScanPeriod = 1.0;         // [s]
constexpr double kMargin = 0.2;             // [s] of rest before and after each scan
constexpr double kKeyframePeriod = 0.1;     // [s] between scans
constexpr double kTravel = 0.4;             // [m] during a moving scan
constexpr double kTurn = 12 * M_PI / 180;   // [rad] during a moving scan
constexpr int kHeadings = 3;

struct ScanMotion {
    CPose3D start, end;
};

ScanMotion moveThrough(const ScanPlace& place, bool moving, Random& random) {
    constexpr double kShift = 0.1, kSwing = 0.15, kLean = 0.015;  // [m], [rad], [rad]
    const double x = place.x + random.uniform(-kShift, kShift);
    const double y = place.y + random.uniform(-kShift, kShift);
    const double z = Scene::floorHeight();
    const double yaw = place.heading + random.uniform(-kSwing, kSwing);
    // Soft springs: a reader that drops roll and pitch, or swaps the angles, shows.
    const double pitch = random.uniform(-kLean, kLean), roll = random.uniform(-kLean, kLean);
    if (!moving) return {{x, y, z, yaw, pitch, roll}, {x, y, z, yaw, pitch, roll}};
    const double dx = 0.5 * kTravel * std::cos(yaw), dy = 0.5 * kTravel * std::sin(yaw);
    return {{x - dx, y - dy, z, yaw - 0.5 * kTurn, pitch, roll},
            {x + dx, y + dy, z, yaw + 0.5 * kTurn, pitch, roll}};
}

/** From the last keyframe to the pose, at even speed. */
void travelTo(Trajectory& trajectory, double end, const CPose3D& to) {
    const TimedPose from = trajectory.keyframes().back();
    Trajectory leg;
    leg.add(from.time, from.pose);
    leg.add(end, to);
    const int steps = static_cast<int>(std::lround((end - from.time) / kKeyframePeriod));
    for (int i = 1; i < steps; i++) {
        const double time = from.time + (end - from.time) * i / steps;
        trajectory.add(time, leg.at(time));
    }
    trajectory.add(end, to);
}

}  // namespace

Trajectory::Trajectory() {
    interpolator_.setInterpolationMethod(mrpt::poses::imLinearSlerp);
}

void Trajectory::add(double time, const CPose3D& pose) {
    keyframes_.push_back({time, pose});
    interpolator_.insert(mrpt::Clock::fromDouble(time), pose);
}

CPose3D Trajectory::at(double time) const {
    CPose3D pose;
    bool valid = false;
    interpolator_.interpolate(mrpt::Clock::fromDouble(time), pose, valid);
    if (!valid) throw std::out_of_range("the drive has no pose at time " + std::to_string(time));
    return pose;
}

Drive makeDrive(const Scene& scene, bool moving, uint64_t seed) {
    Drive drive;
    Random random(seed, 2);
    double time = kFirstScan;
    for (const ScanPlace& place : scene.places())
        for (int i = 0; i < kHeadings; i++) {
            const ScanPlace stand{place.x, place.y, place.heading + i * 2 * M_PI / kHeadings};
            const ScanMotion motion = moveThrough(stand, moving, random);
            Trajectory& trajectory = drive.trajectory;
            if (drive.scan_times.empty())
                trajectory.add(time - kMargin, motion.start);
            else
                travelTo(trajectory, time - kMargin, motion.start);
            trajectory.add(time, motion.start);
            trajectory.add(time + kScanSeconds, motion.end);
            trajectory.add(time + kScanSeconds + kMargin, motion.end);
            drive.scan_times.push_back(time);
            time += kScanPeriod;
        }
    return drive;
}

}  // namespace akimap::app
