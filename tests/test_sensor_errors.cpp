// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
//
// What is wrong with simulated ranges: each error alone, against small scenes of known distances.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "input/scan_feed.h"
#include "simulation/simulate.h"

namespace {

using namespace akimap::app;
using mrpt::math::TPoint3D;
using mrpt::math::TVector3D;
using mrpt::poses::CPose3D;

constexpr int kShots = 20000;

TPoint3D point(const std::array<double, 3>& p) {
    return {p[0], p[1], p[2]};
}

/** A wall whose face is at this x. */
void addWall(Scene& scene, double x, Material material = Material::matte) {
    scene.add(makeBox({x + 0.005, 0, 0, 0, 0, 0}, {0.01, 20, 20}), material);
}
Scene wallAt(double x, Material material = Material::matte) {
    Scene scene;
    addWall(scene, x, material);
    return scene;
}

/** Ranges measured from the origin; NaN where there is no return. */
std::vector<double> shoot(const Scene& scene, const RangeErrors& errors,
                          const TVector3D& direction = {1, 0, 0}, double forward = 1) {
    const Trajectory nowhere;
    const World world{scene, nowhere, false, errors, 50};
    Random random(1, 99);
    std::vector<double> ranges;
    for (int i = 0; i < kShots; i++)
        ranges.push_back(
            measureRange(world, {0, 0, 0}, direction, 0.1, random, forward).value_or(NAN));
    return ranges;
}
RangeErrors only(double RangeErrors::*error, double value) {
    RangeErrors errors;
    errors.*error = value;
    return errors;
}

double deviation(
    const std::vector<double>& values, double from,
    const std::function<double(double)>& of = [](double v) { return v; }) {
    double squares = 0;
    for (const double v : values) squares += (of(v) - from) * (of(v) - from);
    return std::sqrt(squares / static_cast<double>(values.size()));
}
double share(const std::vector<double>& values, const std::function<bool(double)>& is) {
    return static_cast<double>(std::count_if(values.begin(), values.end(), is)) /
           static_cast<double>(values.size());
}
double shareLost(const std::vector<double>& ranges) {
    return share(ranges, [](double r) { return std::isnan(r); });
}

TEST(RangeErrors, NoneIsExact) {
    for (const double range : shoot(wallAt(2), {})) ASSERT_EQ(range, 2.0);
}

TEST(RangeErrors, NoiseIsConstantOrGrowsWithTheRange) {
    EXPECT_NEAR(deviation(shoot(wallAt(2), only(&RangeErrors::constant, 0.01)), 2), 0.01, 2e-4);
    EXPECT_NEAR(deviation(shoot(wallAt(2), only(&RangeErrors::linear, 0.01)), 2), 0.02, 4e-4);
    EXPECT_NEAR(deviation(shoot(wallAt(6), only(&RangeErrors::linear, 0.01)), 6), 0.06, 1e-3);
}

TEST(RangeErrors, DisparityNoiseGrowsWithTheSquareOfTheDepth) {
    const RangeErrors errors = only(&RangeErrors::disparity, 1e-3);
    EXPECT_NEAR(deviation(shoot(wallAt(2), errors), 2), 0.004, 1e-4);
    EXPECT_NEAR(deviation(shoot(wallAt(4), errors), 4), 0.016, 4e-4);
    // The depth of a ray 60 degrees off the axis is half its range.
    const auto ranges = shoot(wallAt(2), errors, {1, 0, 0}, 0.5);
    EXPECT_NEAR(deviation(ranges, 1.0, [](double r) { return 1 / (0.5 * r); }), 1e-3, 3e-5);
}

TEST(RangeErrors, StepsQuantizeDisparityOrRange) {
    RangeErrors errors = only(&RangeErrors::disparity, 3e-3);
    errors.disparity_step = 2.85e-3;
    for (const double range : shoot(wallAt(3), errors, {1, 0, 0}, 0.8)) {
        const double steps = 1 / (0.8 * range) / errors.disparity_step;
        ASSERT_NEAR(steps, std::round(steps), 1e-9);
    }
    errors = only(&RangeErrors::linear, 0.01), errors.range_step = 0.012;
    for (const double range : shoot(wallAt(3), errors))
        ASSERT_NEAR(range / 0.012, std::round(range / 0.012), 1e-9);
}

/** A box whose face is at x = 2 and whose edge is at y = 0, before a wall. */
Scene edge(double wall) {
    Scene scene = wallAt(wall);
    scene.add(makeBox({2.05, -1, 0, 0, 0, 0}, {0.1, 2, 2}));
    return scene;
}

TEST(RangeErrors, APixelOnAnEdgeMixesBothSurfaces) {
    RangeErrors errors = only(&RangeErrors::beam, 0.01);
    errors.mixing = 0.5;
    const auto mixed = shoot(edge(2.3), errors, TVector3D(2, -1e-6, 0).unitarize());
    for (const double range : mixed) {
        ASSERT_GE(range, 2 - 1e-9);
        ASSERT_LE(range, 2.3 * (1 + 1e-4));
    }
    // Half of the beam is off the box.
    EXPECT_NEAR(share(mixed, [](double r) { return r > 2.0001; }), 0.5, 0.02);
    EXPECT_NEAR(share(mixed, [](double r) { return r > 2.15; }), 0.25, 0.02);
    // Deeper edges give one of both.
    const auto split = shoot(edge(3), errors, TVector3D(2, -1e-6, 0).unitarize());
    EXPECT_NEAR(share(split, [](double r) { return std::abs(r - 2) < 1e-3; }), 0.75, 0.02);
    EXPECT_NEAR(share(split, [](double r) { return std::abs(r - 3) < 1e-3; }), 0.25, 0.02);
    // A beam that is wholly on the box: 2 m away it is 2 cm wide.
    const TVector3D aside = TVector3D(2, -0.011, 0).unitarize();
    for (const double range : shoot(edge(2.3), errors, aside)) ASSERT_NEAR(range, 2, 1e-4);
}

TEST(RangeErrors, FlatIncidenceLosesReturns) {
    const RangeErrors errors = only(&RangeErrors::grazing, 0.2);
    const auto at = [](double cosine) {
        return TVector3D(cosine, std::sqrt(1 - cosine * cosine), 0);
    };
    EXPECT_EQ(shareLost(shoot(wallAt(0.5), errors, at(0.25))), 0);
    EXPECT_NEAR(shareLost(shoot(wallAt(0.5), errors, at(0.1))), 0.5, 0.02);
    EXPECT_NEAR(shareLost(shoot(wallAt(0.3), errors, at(0.05))), 0.75, 0.02);
}

TEST(RangeErrors, DarkThingsLoseReturnsAndGlassIsSeenThrough) {
    const RangeErrors dark = only(&RangeErrors::dark_loss, 0.6);
    EXPECT_EQ(shareLost(shoot(wallAt(2), dark)), 0);
    EXPECT_NEAR(shareLost(shoot(wallAt(2, Material::dark), dark)), 0.6, 0.02);

    Scene window = wallAt(2, Material::glass);
    addWall(window, 3);
    for (const double range : shoot(window, dark)) ASSERT_EQ(range, 2.0);
    const auto ranges = shoot(window, only(&RangeErrors::glass_pass, 0.9));
    EXPECT_NEAR(share(ranges, [](double r) { return r == 3.0; }), 0.9, 0.01);
    EXPECT_NEAR(share(ranges, [](double r) { return r == 2.0; }), 0.1, 0.01);
}

TEST(RangeErrors, WhatARayMeetsDoesNotChangeTheErrorsOfTheNext) {
    const Scene near = wallAt(2), none;
    const Trajectory nowhere;
    const RangeErrors errors = sensorModel(SensorKind::kinect).errors;
    Random a(1, 99), b(1, 99);
    const World seen{near, nowhere, false, errors, 5}, unseen{none, nowhere, false, errors, 5};
    EXPECT_TRUE(measureRange(seen, {0, 0, 0}, {1, 0, 0}, 0.5, a));
    EXPECT_FALSE(measureRange(unseen, {0, 0, 0}, {1, 0, 0}, 0.5, b));
    EXPECT_EQ(measureRange(seen, {0, 0, 0}, {1, 0, 0}, 0.5, a),
              measureRange(seen, {0, 0, 0}, {1, 0, 0}, 0.5, b));
}

TEST(RangeErrors, AreRefusedWhereTheyCannotBe) {
    const auto expectRefused = [](const RangeErrors& errors, const std::string& word) {
        SimulationOptions options;
        options.errors = errors;
        try {
            simulate(options);
            ADD_FAILURE() << word;
        } catch (const std::runtime_error& e) {
            EXPECT_NE(std::string(e.what()).find(word), std::string::npos) << e.what();
        }
    };
    expectRefused(only(&RangeErrors::constant, NAN), "range noise");
    expectRefused(only(&RangeErrors::linear, -1), "grows");
    expectRefused(only(&RangeErrors::disparity, INFINITY), "disparity noise");
    expectRefused(only(&RangeErrors::disparity_step, -1), "disparity step");
    expectRefused(only(&RangeErrors::range_step, -1), "range step");
    expectRefused(only(&RangeErrors::beam_offset, -1), "beam offset");
    expectRefused(only(&RangeErrors::beam, 0.2), "beam width");
    expectRefused(only(&RangeErrors::mixing, -1), "mixing");
    expectRefused(only(&RangeErrors::grazing, 1.1), "grazing");
    expectRefused(only(&RangeErrors::dark_loss, 1.1), "dark");
    expectRefused(only(&RangeErrors::glass_pass, -0.1), "glass");
}

TEST(RangeErrors, EachBeamKeepsItsOffset) {
    SimulationOptions options;
    options.sensor = SensorKind::velodyne, options.errors = RangeErrors();
    const SimulatedDrive exact = simulate(options);
    options.errors->beam_offset = 0.01;
    const SimulatedDrive off = simulate(options);
    std::map<long, double> offsets;  // by the beam's elevation [degrees], in the sensor's frame
    for (std::size_t i = 0; i < exact.scans.size(); i++) {
        const CPose3D sensor = exact.scans[i].views.front().sensor;
        ASSERT_EQ(exact.scans[i].rays.size(), off.scans[i].rays.size());
        for (std::size_t j = 0; j < exact.scans[i].rays.size(); j++) {
            const TPoint3D a = sensor.inverseComposePoint(point(exact.scans[i].rays[j].end));
            const TPoint3D b = sensor.inverseComposePoint(point(off.scans[i].rays[j].end));
            const long beam = std::lround(std::atan2(a.z, std::hypot(a.x, a.y)) * 180 / M_PI);
            const double offset = b.norm() - a.norm();
            ASSERT_NEAR(offsets.emplace(beam, offset).first->second, offset, 2.1e-3);  // 2 mm steps
        }
    }
    EXPECT_EQ(offsets.size(), 16u);
    double squares = 0;
    for (const auto& [beam, offset] : offsets) squares += offset * offset / 16;
    EXPECT_NEAR(std::sqrt(squares), 0.01, 0.005);
}

class Presets : public testing::TestWithParam<SensorKind> {};

TEST_P(Presets, ObservationsDecodeToTheDrivesOwnRays) {
    SimulationOptions options;
    options.scene = SceneKind::furnished, options.sensor = GetParam();
    const SimulatedDrive drive = simulate(options);
    const SensorModel model = sensorModel(GetParam());
    for (std::size_t i = 0; i < drive.scans.size(); i += 5) {
        const SimulatedScan& scan = drive.scans[i];
        const auto rays = raysOf({scan.observation, scan.robot_pose, nullptr, {}}, false);
        ASSERT_EQ(rays.size(), scan.rays.size());
        EXPECT_GT(rays.size(), 3000u);
        for (std::size_t j = 0; j < rays.size(); j++) {
            ASSERT_LT(point(rays[j].origin).distanceTo(point(scan.rays[j].origin)), 1e-5);
            ASSERT_LT(point(rays[j].end).distanceTo(point(scan.rays[j].end)), 4e-3);
            const double range = point(rays[j].end).distanceTo(point(rays[j].origin));
            ASSERT_GT(range, model.min_range - 0.01);  // steps
            ASSERT_LT(range, model.max_range + 0.01);
        }
    }
}

TEST_P(Presets, SameSeedSameBits) {
    const auto drive = [&](uint64_t seed) {
        SimulationOptions options;
        options.scene = SceneKind::furnished, options.sensor = GetParam(), options.seed = seed;
        options.pose_errors = {0.01, 0.01, 0.005, 0.002};
        std::vector<std::array<double, 3>> ends;
        for (const auto& scan : simulatedRays(options))
            for (const akimap::Ray& ray : scan) ends.push_back(ray.end);
        return ends;
    };
    const auto first = drive(5);
    EXPECT_EQ(drive(5), first);
    EXPECT_NE(drive(6), first);
}

INSTANTIATE_TEST_SUITE_P(All, Presets,
                         testing::Values(SensorKind::kinect, SensorKind::realsense,
                                         SensorKind::vlp16, SensorKind::os1_128,
                                         SensorKind::os0_64));

TEST(Presets, KinectsDepthIsOffByHalfADisparityStep) {
    // Sensors 12 (2012), 1437: 1.42e-3 / m times the square of the depth.
    for (const double depth : {1.5, 3.0, 4.5}) {
        RangeErrors errors = sensorModel(SensorKind::kinect).errors;
        errors.constant = 0;
        // Around the depth, for its rounding differs from place to place.
        double sum = 0;
        for (int i = 0; i < 10; i++) {
            const double at = depth + 0.003 * i * depth;
            const double off = deviation(shoot(wallAt(at), errors), at) / (at * at);
            sum += off * off;
        }
        EXPECT_NEAR(std::sqrt(sum / 10), 1.42e-3, 1e-4) << depth;
    }
}

}  // namespace
