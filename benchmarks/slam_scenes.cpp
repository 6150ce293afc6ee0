// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "slam_scenes.h"

#include <cmath>

#include "simulation/Random.h"

namespace akimap::bench {
namespace {

using mrpt::maps::CSimplePointsMap;
using mrpt::math::TPoint3D;
using mrpt::poses::CPose2D;
using mrpt::poses::CPose3D;

constexpr double kLaserHeight = 0.5;
constexpr int kQueries = 50;
constexpr double kDegree = M_PI / 180;

app::SimulatedDrive drive(uint64_t seed) {
    app::SimulationOptions o;
    o.seed = seed;
    return app::simulate(o);
}

mrpt::obs::CObservation2DRangeScan::Ptr scanFrom(const app::Scene& scene, const CPose2D& robot,
                                                 app::Random& random) {
    constexpr std::size_t kBeams = 360;
    auto scan = mrpt::obs::CObservation2DRangeScan::Create();
    scan->aperture = static_cast<float>(2 * M_PI * (kBeams - 1) / kBeams);
    scan->maxRange = 20, scan->sensorPose = CPose3D(0, 0, kLaserHeight, 0, 0, 0);
    scan->resizeScan(kBeams);
    for (std::size_t i = 0; i < kBeams; i++) {
        const double a = robot.phi() + scan->getScanAngle(i);
        const auto range = scene.castRay(TPoint3D(robot.x(), robot.y(), kLaserHeight),
                                         {std::cos(a), std::sin(a), 0});
        scan->setScanRange(i, range ? static_cast<float>(*range + random.normal(0.01)) : 0.f);
        scan->setScanRangeValidity(i, range.has_value());
    }
    return scan;
}

void insert(const Ray& r, CSimplePointsMap& points) {
    points.insertPointFast(static_cast<float>(r.end[0]), static_cast<float>(r.end[1]),
                           static_cast<float>(r.end[2]));
}

std::array<double, 3> moved(const CPose3D& pose, const std::array<double, 3>& p) {
    std::array<double, 3> q{};
    pose.composePoint(p[0], p[1], p[2], q[0], q[1], q[2]);
    return q;
}

/** The rays as seen from a frame. */
std::vector<Ray> moved(const CPose3D& pose, std::vector<Ray> rays) {
    for (Ray& r : rays) r = {moved(pose, r.origin), moved(pose, r.end)};
    return rays;
}

std::vector<Ray> raysOf(const FlatScan& s) {
    const CPose3D sensor = CPose3D(s.robot) + s.observation->sensorPose;
    std::vector<Ray> rays;
    for (std::size_t i = 0; i < s.observation->getScanSize(); i++) {
        if (!s.observation->getScanRangeValidity(i)) continue;
        const double r = s.observation->getScanRange(i), a = s.observation->getScanAngle(i);
        rays.push_back({{sensor.x(), sensor.y(), sensor.z()},
                        moved(sensor, {r * std::cos(a), r * std::sin(a), 0})});
    }
    return rays;
}

CPose3D offset(bool flat, app::Random& random) {
    std::array<double, 3> t{}, r{};
    const auto inBall = [&](std::array<double, 3>& v) {
        do
            for (double& c : v) c = random.uniform(-1, 1);
        while (v[0] * v[0] + v[1] * v[1] + v[2] * v[2] > 1);
    };
    inBall(t), inBall(r);
    if (flat) return {0.3 * t[0], 0.3 * t[1], 0, 10 * kDegree * r[0], 0, 0};
    return {0.3 * t[0],          0.3 * t[1],          0.3 * t[2],
            10 * kDegree * r[0], 10 * kDegree * r[1], 10 * kDegree * r[2]};
}

/** A scan to align: its rays in the frame of the maps, and where the robot was. */
struct Taken {
    std::vector<Ray> rays;
    CPose3D robot;
};

std::vector<Taken> taken(bool flat, uint64_t seed, const CPose3D& frame) {
    std::vector<Taken> all;
    if (flat)
        for (const auto& s : flatScans(seed))
            all.push_back({moved(frame, raysOf(s)), frame + CPose3D(s.robot)});
    else
        for (const auto& s : drive(seed).scans)
            all.push_back({moved(frame, s.rays), frame + s.robot_pose});
    return all;
}

std::unique_ptr<IcpCase> icpCase(const std::string& name, bool flat, bool flat_map,
                                 const CPose3D& frame) {
    auto c = std::make_unique<IcpCase>();
    c->name = name, c->flat = flat;
    for (const auto& s : taken(flat_map, 1, frame)) c->aki.insertRays(s.rays);
    for (const auto& s : taken(flat, 1, frame))
        for (const Ray& r : s.rays) insert(r, c->points);
    c->points.mark_as_modified();
    const auto scans = taken(flat, 2, frame);
    app::Random random(7, 0);
    for (std::size_t i = 0; i < kQueries; i++) {
        const Taken& s = scans[i % scans.size()];
        IcpQuery q;
        q.truth = s.robot, q.guess = s.robot + offset(flat, random);
        for (const Ray& r : moved(-s.robot, s.rays)) insert(r, q.cloud);
        q.cloud.mark_as_modified();
        c->queries.push_back(std::move(q));
    }
    return c;
}

}  // namespace

std::vector<FlatScan> flatScans(uint64_t seed) {
    const auto d = drive(seed);
    app::Random random(seed, 9);
    std::vector<FlatScan> scans;
    for (const auto& s : d.scans) {
        const CPose2D robot(s.robot_pose.x(), s.robot_pose.y(), s.robot_pose.yaw());
        scans.push_back({scanFrom(d.scene, robot, random), robot});
    }
    return scans;
}

std::vector<std::unique_ptr<IcpCase>> icpCases() {
    const CPose3D room, turned(0.013, 0.021, 0, 0.3, 0, 0);
    std::vector<std::unique_ptr<IcpCase>> cases;
    cases.push_back(icpCase("3D, the room", false, false, room));
    cases.push_back(icpCase("3D, turned and shifted", false, false, turned));
    cases.push_back(icpCase("2D, the room", true, true, room));
    cases.push_back(icpCase("2D, turned and shifted", true, true, turned));
    cases.push_back(icpCase("2D against 3D scans, turned", true, false, turned));
    return cases;
}

}  // namespace akimap::bench
