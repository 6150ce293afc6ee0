// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
// The model: a return is worth most on a surface, less in the unknown, least in free space.
#include <akimap/AkiMap.h>
#include <gtest/gtest.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/obs/CObservationVelodyneScan.h>

#include <cmath>
#include <random>
#include <thread>

using namespace akimap;
using mrpt::poses::CPose3D;

namespace {

/** Distance to the wall of a room of 6 x 4 m around the origin, with a niche in one side. */
double wallDistance(double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    const double to_x = (c > 0 ? 3.5 : -2.5) / c, to_y = (s > 0 ? 1.5 : -2.5) / s;
    const double d = std::min(std::abs(to_x), std::abs(to_y));
    return angle > 0.3 && angle < 0.6 ? 0.7 * d : d;
}

mrpt::obs::CObservation2DRangeScan scan() {
    mrpt::obs::CObservation2DRangeScan s;
    s.aperture = static_cast<float>(2 * M_PI * 359 / 360), s.maxRange = 20;
    s.sensorPose = CPose3D(0, 0, 0.52, 0, 0, 0);
    s.resizeScan(360);
    std::mt19937 random(1);
    std::normal_distribution<double> noise(0, 0.005);
    for (std::size_t i = 0; i < 360; i++) {
        s.setScanRange(i, static_cast<float>(wallDistance(s.getScanAngle(i)) + noise(random)));
        s.setScanRangeValidity(i, i % 20 != 0);
    }
    return s;
}

AkiMap roomMap() {
    AkiMap map(0.05);
    EXPECT_TRUE(map.insertObservation(scan()));
    return map;
}

mrpt::obs::CObservationPointCloud onePoint(double x, double y, double z) {
    mrpt::obs::CObservationPointCloud o;
    o.pointcloud = mrpt::maps::CSimplePointsMap::Create();
    o.pointcloud->insertPoint(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z));
    return o;
}

}  // namespace

TEST(Likelihood, PeaksAtTheTruePose) {
    const AkiMap map = roomMap();
    const auto s = scan();
    const double at_truth = map.computeObservationLikelihood(s, CPose3D());
    double previous = at_truth;
    for (const double d : {0.15, 0.3, 0.6}) {  // falls with the distance, to all sides
        double best = -1e9;
        for (double a = 0; a < 6; a += 0.7)
            best = std::max(best, map.computeObservationLikelihood(
                                      s, CPose3D(d * std::cos(a), d * std::sin(a), 0, 0, 0, 0)));
        EXPECT_LT(best, previous) << d;
        previous = best;
    }
    for (const double yaw : {-1.5, -0.3, -0.1, 0.1, 0.3, 1.5, 3.0})
        EXPECT_LT(map.computeObservationLikelihood(s, CPose3D(0, 0, 0, yaw, 0, 0)), at_truth);
}

TEST(Likelihood, SurfaceBeatsUnknownBeatsFree) {
    const AkiMap map = roomMap();
    ASSERT_GT(map.occupancy(3.5, 0.02, 0.52).value(), 0.9);
    ASSERT_LT(map.occupancy(1.5, 0.02, 0.52).value(), 0.1);
    ASSERT_FALSE(map.occupancy(1.5, 0.02, 3.5));
    const CPose3D here(0.1, 0.01, 0.02, 0, 0, 0);
    const auto at = [&](double x, double y, double z) {
        return map.computeObservationLikelihood(onePoint(x, y, z), here);
    };
    const double surface = at(3.4, 0.01, 0.5), free = at(1.4, 0.01, 0.5), unknown = at(1, 0, 3.5);
    EXPECT_GT(surface, unknown);
    EXPECT_GT(unknown, free);
    const auto& l = map.likelihoodOptions;
    EXPECT_NEAR(free, std::log(l.p_outlier), 0.01);
    EXPECT_NEAR(unknown, std::log(l.p_outlier + (1 - l.p_outlier) * l.p_unknown), 1e-9);
    EXPECT_LE(surface, 0);
    // All unknown places are worth the same, near, far, and beyond what can be addressed.
    EXPECT_DOUBLE_EQ(unknown, at(-1, 1, 3));
    EXPECT_DOUBLE_EQ(
        unknown, map.computeObservationLikelihood(onePoint(1, 0, 0), CPose3D(1e7, 0, 0, 0, 0, 0)));
    EXPECT_DOUBLE_EQ(unknown, AkiMap().computeObservationLikelihood(onePoint(1, 0, 0), here));
}

TEST(Likelihood, AReturnBehindAWallIsNotExplainedByTheUnknownThere) {
    const AkiMap map = roomMap();
    const CPose3D here;
    const double behind = map.computeObservationLikelihood(onePoint(3.62, 0.02, 0.52), here);
    const double on = map.computeObservationLikelihood(onePoint(3.5, 0.02, 0.52), here);
    EXPECT_LT(behind, on - 0.3);
}

TEST(Likelihood, IsFiniteEverywhere) {
    const AkiMap map = roomMap(), empty;
    const auto s = scan();
    std::mt19937 random(4);
    std::uniform_real_distribution<double> unit(-1, 1);
    for (const double size : {1., 10., 1e4, 1e9, 1e300})
        for (int i = 0; i < 50; i++) {
            const CPose3D pose(size * unit(random), size * unit(random), unit(random),
                               3 * unit(random), unit(random), unit(random));
            EXPECT_TRUE(std::isfinite(map.computeObservationLikelihood(s, pose)));
            EXPECT_TRUE(std::isfinite(empty.computeObservationLikelihood(s, pose)));
        }
    auto broken = onePoint(1, 0, 0);
    broken.pointcloud->insertPoint(NAN, 0, 0);
    broken.pointcloud->insertPoint(0, 0, 0);
    EXPECT_TRUE(std::isfinite(map.computeObservationLikelihood(broken, CPose3D())));
    EXPECT_EQ(map.computeObservationLikelihood(broken, CPose3D(NAN, 0, 0, 0, 0, 0)), 0);
}

TEST(Likelihood, ObservationsWithoutReturnsSayNothing) {
    const AkiMap map = roomMap();
    mrpt::obs::CObservation2DRangeScan none;
    none.resizeScan(0);
    EXPECT_EQ(map.computeObservationLikelihood(none, CPose3D()), 0);
    EXPECT_EQ(map.computeObservationLikelihood(mrpt::obs::CObservationPointCloud(), CPose3D()), 0);
    EXPECT_EQ(map.computeObservationLikelihood(mrpt::obs::CObservationVelodyneScan(), CPose3D()),
              0);
    EXPECT_EQ(map.computeObservationLikelihood(mrpt::obs::CObservation3DRangeScan(), CPose3D()), 0);
}

TEST(Likelihood, EveryOptionIsLive) {
    const auto s = scan();
    const CPose3D pose(0.5, 0.4, 0, 0.02, 0, 0);  // where some returns end in the unknown
    AkiMap map = roomMap();
    const double usual = map.computeObservationLikelihood(s, pose);
    const auto changed = [&](auto change) {
        AkiMap other = map;
        change(other.likelihoodOptions);
        return other.computeObservationLikelihood(s, pose);
    };
    EXPECT_NE(usual, changed([](auto& l) { l.decimation = 7; }));
    EXPECT_NE(usual, changed([](auto& l) { l.sigma_hit = 0; }));
    EXPECT_NE(usual, changed([](auto& l) { l.p_unknown = 0.4; }));
    EXPECT_NE(usual, changed([](auto& l) { l.p_outlier = 0.2; }));
    // Twice the independent returns, twice the evidence; never more than there are.
    const double n = map.likelihoodOptions.independent_returns;
    EXPECT_NEAR(changed([&](auto& l) { l.independent_returns = 2 * n; }), 2 * usual, 1e-9);
    EXPECT_NEAR(changed([&](auto& l) { l.independent_returns = 1e9; }), usual * 342 / n, 1e-6);
    // Certain of everything, far from the map: the product must not underflow.
    EXPECT_TRUE(std::isfinite(changed(
        [](auto& l) { l.p_outlier = 1e-300, l.p_unknown = 1e-300, l.independent_returns = 1e9; })));
}

TEST(Likelihood, SameForAScanAndItsPoints) {
    const AkiMap map = roomMap();
    const auto s = scan();
    mrpt::obs::CObservationPointCloud cloud;
    cloud.sensorPose = s.sensorPose;
    cloud.pointcloud = mrpt::maps::CSimplePointsMap::Create();
    mrpt::obs::CObservationVelodyneScan velodyne;
    velodyne.sensorPose = s.sensorPose;
    for (std::size_t i = 0; i < 360; i++) {
        if (!s.getScanRangeValidity(i)) continue;
        const double r = s.getScanRange(i), a = s.getScanAngle(i);
        const auto x = static_cast<float>(r * std::cos(a)), y = static_cast<float>(r * std::sin(a));
        cloud.pointcloud->insertPointFast(x, y, 0);
        velodyne.point_cloud.x.push_back(x), velodyne.point_cloud.y.push_back(y);
        velodyne.point_cloud.z.push_back(0);
    }
    const CPose3D pose(0.05, -0.02, 0, 0.03, 0, 0);
    const double expected = map.computeObservationLikelihood(s, pose);
    EXPECT_NEAR(map.computeObservationLikelihood(cloud, pose), expected, 0.02);
    EXPECT_NEAR(map.computeObservationLikelihood(velodyne, pose), expected, 0.02);
    EXPECT_FALSE(s.getAuxPointsMap<mrpt::maps::CMetricMap>());  // the scan was left as it was
}

TEST(Likelihood, ManyThreadsAtOnceAgree) {
    const AkiMap map = roomMap();
    const auto s = scan();
    const auto run = [&] {
        double sum = 0;
        for (int i = 0; i < 200; i++)
            sum += map.computeObservationLikelihood(s, CPose3D(0.01 * i, 0, 0, 0.02 * i, 0, 0));
        return sum;
    };
    std::vector<double> sums(8);
    std::vector<std::thread> threads;
    for (double& sum : sums) threads.emplace_back([&] { sum = run(); });
    for (auto& t : threads) t.join();
    for (const double sum : sums) EXPECT_EQ(sum, run());
}

TEST(Likelihood, BadOptionsSetInCodeAreNamed) {
    AkiMap map = roomMap();
    const auto expectRefusal = [&](const std::string& name, auto&& set) {
        map.likelihoodOptions = {};
        set(map.likelihoodOptions);
        try {
            map.computeObservationLikelihood(scan(), CPose3D());
            ADD_FAILURE() << name << " was taken";
        } catch (const std::invalid_argument& e) {
            EXPECT_NE(std::string(e.what()).find(name), std::string::npos) << e.what();
        }
    };
    expectRefusal("p_outlier", [](auto& l) { l.p_outlier = 0; });
    expectRefusal("p_unknown", [](auto& l) { l.p_unknown = 1; });
    expectRefusal("sigma_hit", [](auto& l) { l.sigma_hit = -1; });
    expectRefusal("decimation", [](auto& l) { l.decimation = 0; });
    expectRefusal("independent_returns", [](auto& l) { l.independent_returns = 0; });
}

TEST(Likelihood, AReturnAtExactlyMaxRangeIsUsedFromEveryPose) {
    AkiMap map = roomMap();
    const auto at = [&](double length, double turn) {
        return map.computeObservationLikelihood(onePoint(length, 0, 0.52),
                                                CPose3D(0.1, 0.2, 0, turn, 0.01 * turn, 0));
    };
    map.insertionOptions.max_range = std::sqrt(9 + 0.52 * 0.52);
    map.insertionOptions.min_range = map.insertionOptions.max_range;
    for (int i = 0; i < 200; i++) EXPECT_NE(at(3, 0.03 * i), 0) << "turn " << i;
    EXPECT_EQ(at(2.9, 0), 0);
    EXPECT_EQ(at(3.1, 0), 0);
}

TEST(Likelihood, SwitchedOffItIsZeroAndSaysSo) {
    AkiMap map = roomMap();
    EXPECT_TRUE(map.canComputeObservationLikelihood(scan()));
    map.genericMapParams.enableObservationLikelihood = false;
    EXPECT_FALSE(map.canComputeObservationLikelihood(scan()));
    EXPECT_EQ(map.computeObservationLikelihood(scan(), CPose3D()), 0);
}
