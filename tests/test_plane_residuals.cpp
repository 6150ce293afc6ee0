// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
//
// Noise by range, told from scans alone: known noise on known planes; and what is no plane.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <functional>

#include "plane_residuals.h"
#include "scenes.h"
#include "simulation/Random.h"

namespace {

using namespace akimap;
using namespace akimap::bench;

/** A scan of 100 x 100 rays, 0.4 degrees apart. \param range  [m] along the unit direction */
std::vector<Ray> scanOf(const std::function<double(double x, double y, double z)>& range) {
    constexpr double kStep = 0.007;
    std::vector<Ray> rays;
    for (int i = -50; i < 50; i++)
        for (int j = -50; j < 50; j++) {
            const double y = std::tan(kStep * i), z = std::tan(kStep * j);
            const double norm = std::sqrt(1 + y * y + z * z);
            const double r = range(1 / norm, y / norm, z / norm);
            rays.push_back({{1, 2, 3}, {1 + r / norm, 2 + r * y / norm, 3 + r * z / norm}});
        }
    return rays;
}

ResidualOptions bins(std::vector<double> edges) {
    ResidualOptions options;
    options.edges = std::move(edges);
    return options;
}

TEST(PlaneResiduals, AreTheNoiseAlongTheRays) {
    app::Random random(1, 1);
    const auto straight =
        scanOf([&](double x, double, double) { return 3 / x + random.normal(0.01); });
    // A wall turned by 45 degrees: across the plane the noise is less, along the rays it is not.
    const auto slanted =
        scanOf([&](double x, double y, double) { return 3 / (x + y) + random.normal(0.01); });
    for (const auto& scan : {straight, slanted}) {
        const auto found = planeResiduals({scan}, bins({2, 5}));
        ASSERT_EQ(found.size(), 1u);
        EXPECT_GT(found[0].patches, 500u);
        EXPECT_NEAR(found[0].residual, 0.01, 4e-4);
        EXPECT_LT(found[0].lower_quartile, found[0].residual);
        EXPECT_GT(found[0].lower_quartile, 0.008);
    }
}

TEST(PlaneResiduals, AreToldByRange) {
    app::Random random(1, 2);
    const auto noisy = [&](double distance) {
        return scanOf([&, distance](double x, double, double) {
            return distance / x + random.normal(0.002 * distance * distance);
        });
    };
    const auto found = planeResiduals({noisy(1), noisy(2), noisy(4)}, bins({0.5, 1.5, 3, 6, 9}));
    ASSERT_EQ(found.size(), 4u);
    EXPECT_NEAR(found[0].residual, 0.002, 1e-4);
    EXPECT_NEAR(found[1].residual, 0.008, 4e-4);
    EXPECT_NEAR(found[2].residual, 0.032, 2e-3);
    EXPECT_EQ(found[3].patches, 0u);
    EXPECT_TRUE(std::isnan(found[3].residual));
}

TEST(PlaneResiduals, EdgesInSomePatchesDoNotMoveTheMedianMuch) {
    app::Random random(1, 3);
    const auto steps = scanOf(
        [&](double x, double y, double) { return (y > 0 ? 3.0 : 3.5) / x + random.normal(0.01); });
    const auto found = planeResiduals({steps}, bins({2, 5}));
    EXPECT_NEAR(found[0].residual, 0.01, 1e-3);
}

TEST(PlaneResiduals, BinsOutOfOrderAreRefused) {
    for (const auto& edges : {std::vector<double>{}, {1}, {1, 1}, {2, 1}, {1, NAN}})
        EXPECT_THROW((void)planeResiduals({}, bins(edges)), std::invalid_argument);
}

/** Lower quartiles [m] of recordings, by bench_range_noise; see doc/design.md. */
const ResidualOptions kOfficeBins = bins({1, 1.5, 2, 2.5, 3, 3.5, 4});
constexpr double kOffice[] = {0.0021, 0.0041, 0.0065, 0.0090, 0.0118, 0.0182};
const ResidualOptions kLidarBins = bins({0.8, 2, 4, 8, 15});
constexpr double kLidar[] = {0.0050, 0.0037, 0.0062, 0.0101};

std::vector<ResidualBin> simulated(app::SensorKind sensor, const ResidualOptions& options) {
    app::SimulationOptions drive;
    drive.sensor = sensor;
    return planeResiduals(app::simulatedRays(drive), options);
}

TEST(PlaneResiduals, OfSimulatedSensorsAreThoseOfRealOnesWithin30Percent) {
    const auto kinect = simulated(app::SensorKind::kinect, kOfficeBins);
    for (std::size_t i = 0; i < kinect.size(); i++)
        EXPECT_NEAR(kinect[i].lower_quartile, kOffice[i], 0.3 * kOffice[i]) << kinect[i].from;
    const auto lidar = simulated(app::SensorKind::os0_64, kLidarBins);
    for (std::size_t i = 0; i < lidar.size(); i++)
        EXPECT_NEAR(lidar[i].lower_quartile, kLidar[i], 0.3 * kLidar[i]) << lidar[i].from;
}

TEST(PlaneResiduals, OfARealLidarAreAsTheDocumentTells) {
    const char* data = std::getenv("AKIMAP_DATA");
    const Scene scene = pcdFolder("", std::string(data ? data : "") + "/lidar_dense");
    if (scene.scans.empty()) GTEST_SKIP() << "no lidar_dense in $AKIMAP_DATA";
    const auto found = planeResiduals(scene.scans, kLidarBins);
    for (std::size_t i = 0; i < found.size(); i++)
        EXPECT_NEAR(found[i].lower_quartile, kLidar[i], 6e-5) << found[i].from;
}

TEST(PlaneResiduals, FlatPatchesSingleRingsAndNonsenseAreLeftOut) {
    const auto grazing =
        scanOf([](double x, double y, double) { return 1 / (0.2 * x + y + 1e-9); });
    for (const auto& bin : planeResiduals({grazing}, bins({0.5, 4})))
        EXPECT_LT(bin.patches, 800u);  // those below 60 degrees only
    std::vector<Ray> ring;
    for (int i = 0; i < 1000; i++) {
        const double a = 0.002 * i;
        ring.push_back({{0, 0, 0}, {3 * std::cos(a), 3 * std::sin(a), 0.1}});
    }
    ring.push_back({{0, 0, 0}, {NAN, 0, 0}});
    ring.push_back({{0, 0, 0}, {0, 0, 0}});
    EXPECT_EQ(planeResiduals({ring, {}}, bins({0.5, 5}))[0].patches, 0u);
}

}  // namespace
