// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
// The methods that the benchmarks compare with, against small cases worked out by hand and, with
// $AKIMAP_DATA, against what LA3DM's own code gives.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <random>

#include "estimators/kernels/kernel_function.h"
#include "evaluation/evaluate.h"
#include "grid/BlockGrid.h"
#include "input/clouds/PcdReader.h"
#include "rivals/BgkLOctoMap.h"
#include "rivals/BgkOctoMap.h"
#include "rivals/GmmMap.h"

using namespace akimap;
using namespace akimap::bench;

namespace {

using Point = std::array<double, 3>;

/** With a prior of 1 nothing is merged here, and alpha and beta follow from the occupancy. */
BgkOptions withPrior(double prior, BgkOptions o = {}) {
    o.prior = prior;
    return o;
}
template <class Map>
double alphaAt(const Map& map, double x, double y, double z) {  // where beta is 0
    const double p = map.occupancy(x, y, z).value();
    return (2 * p - 1) / (1 - p);
}
template <class Map>
double betaAt(const Map& map, double x, double y, double z) {  // where alpha is 0
    const double p = map.occupancy(x, y, z).value();
    return (1 - 2 * p) / p;
}

}  // namespace

TEST(BgkBlocks, OneHitGivesEachCellTheKernel) {
    BgkBlocks map(withPrior(1));
    const Point hit{0.075, 0.075, 0.025};
    map.add({hit, hit, true}, {hit});
    map.update();
    EXPECT_NEAR(alphaAt(map, 0.075, 0.075, 0.025), 1, 2e-4);
    EXPECT_NEAR(alphaAt(map, 0.025, 0.075, 0.025), 0.5 + 0.5 / M_PI, 2e-4);  // r = 1/4
    EXPECT_NEAR(alphaAt(map, 0.075, -0.025, 0.025), 1. / 6, 2e-4);           // r = 1/2
    EXPECT_NEAR(alphaAt(map, 0.125, 0.075, 0.025), 0.5 + 0.5 / M_PI, 2e-4);  // the next block
    EXPECT_FALSE(map.occupancy(0.125, 0.125, 0.025));  // near, but in a diagonal block
    EXPECT_FALSE(map.occupancy(0.275, 0.075, 0.025));  // r = 1
    EXPECT_FALSE(map.occupancy(5, 5, 5));
}

TEST(BgkBlocks, OneSegmentGivesTheKernelAtItsNearestPoint) {
    BgkBlocks map(withPrior(1));
    map.add({{0.01, 0.025, 0.025}, {0.09, 0.025, 0.025}, false}, {{0.05, 0.025, 0.025}});
    map.update();
    const auto k = [](double distance) { return kernelExact(distance / 0.2); };
    EXPECT_NEAR(betaAt(map, 0.025, 0.075, 0.025), k(0.05), 2e-4);   // beside it
    EXPECT_NEAR(betaAt(map, 0.175, 0.025, 0.025), k(0.085), 2e-4);  // beyond its end
    EXPECT_NEAR(betaAt(map, -0.075, 0.075, 0.025), k(std::hypot(0.085, 0.05)), 2e-4);
}

TEST(BgkBlocks, AFreeBlockBecomesOneLeafWithItsFirstCellsEvidence) {
    BgkBlocks map({});
    const Point center{0, 0, 0};
    const double corner = kernelExact(std::sqrt(3) * 0.075 / 0.2);
    map.add({center, center, false}, {center});
    map.update();
    EXPECT_NEAR(map.occupancy(0.025, 0.025, 0.025).value(), 0.001 / (corner + 0.002), 1e-5);
    EXPECT_EQ(map.occupancy(0.025, 0.025, 0.025), map.occupancy(-0.075, -0.075, -0.075));
    map.add({center, center, false}, {center});  // now seen from the leaf's centre
    map.update();
    EXPECT_NEAR(map.occupancy(0.025, 0.025, 0.025).value(), 0.001 / (1 + corner + 0.002), 1e-6);
}

TEST(BgkOctoMap, PlacesHitAndFreePointsOnTheRay) {
    BgkOptions o = withPrior(1);
    o.max_range = 2;
    BgkOctoMap map(o);
    map.insert({{{0.025, 0.025, 0.025}, {1.225, 0.025, 0.025}},
                {{0.025, 0.025, 0.025}, {0.025, 3.025, 0.025}}});  // too long
    EXPECT_NEAR(alphaAt(map, 1.225, 0.075, 0.025), kernelExact(0.25), 2e-4);
    for (const double x : {0.025, 0.525})  // the origin, 0.5 m
        EXPECT_NEAR(betaAt(map, x, 0.075, 0.025), kernelExact(0.25), 2e-4) << x;
    // Points at 0.725 (0.5 m before the hit) and 1.025 (1 m): 0.875 is 0.15 m from both.
    EXPECT_NEAR(betaAt(map, 0.875, 0.025, 0.025), 2 * kernelExact(0.75), 4e-4);
    EXPECT_FALSE(map.occupancy(0.275, 0.025, 0.025));  // 0.25 m from each
    EXPECT_FALSE(map.occupancy(0.025, 3.025, 0.025));
}

TEST(BgkLOctoMap, CountsTheSegmentOnceForEachNearBlockThatHoldsIt) {
    BgkLOctoMap map(withPrior(1, BgkLOctoMap::defaults()));
    map.insert({{{0.025, 0.025, 0.025}, {0.825, 0.025, 0.025}}});
    // Free up to 0.525; held by the blocks at x = 0, 0.2 and 0.6.
    EXPECT_NEAR(betaAt(map, 0.025, 0.075, 0.025), 0.1 * 2 * kernelExact(0.25), 4e-5);
    EXPECT_NEAR(betaAt(map, 0.425, 0.075, 0.025), 0.1 * 2 * kernelExact(0.25), 4e-5);
    EXPECT_NEAR(betaAt(map, 0.525, 0.075, 0.025), 0.1 * 1 * kernelExact(0.25), 4e-5);
    EXPECT_NEAR(alphaAt(map, 0.825, 0.075, 0.025), 0.1 * kernelExact(0.25), 4e-5);
}

TEST(Downsampling, OneMeanRayAVoxel) {
    const auto rays = downsample({{{0, 0, 0}, {0.11, 0.21, 0.01}},
                                  {{0, 0, 0}, {0.16, 0.21, 0.01}},
                                  {{0, 0, 0.2}, {0.13, 0.23, 0.03}}},
                                 0.05);
    ASSERT_EQ(rays.size(), 2u);
    EXPECT_NEAR(rays[0].origin[2], 0.1, 1e-12);
    EXPECT_NEAR(rays[0].end[0], 0.12, 1e-12);
    EXPECT_NEAR(rays[0].end[1], 0.22, 1e-12);
    EXPECT_NEAR(rays[1].end[0], 0.16, 1e-12);
}

TEST(Mixture, OneGaussianIsTheMeanAndCovarianceOfThePoints) {
    // A corner of each octant about (1, 2, 3): variances are the half-sides squared.
    std::vector<Eigen::Vector3d> points;
    for (int copy = 0; copy < 2; copy++)
        for (const double x : {-0.1, 0.1})
            for (const double y : {-0.2, 0.2})
                for (const double z : {-0.3, 0.3}) points.emplace_back(1 + x, 2 + y, 3 + z + x);
    const Mixture m = fitMixture(points, 1, 100, 1);
    ASSERT_EQ(m.weights.size(), 1u);
    Eigen::Matrix3d expected;
    expected << 0.01, 0, 0.01, 0, 0.04, 0, 0.01, 0, 0.10;
    EXPECT_LT((m.means[0] - Eigen::Vector3d(1, 2, 3)).norm(), 1e-9);
    EXPECT_LT((m.covariances[0] - expected).norm(), 1e-5);
}

TEST(Mixture, TellsOverlappingGaussiansApart) {
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    std::vector<Eigen::Vector3d> points;
    for (int i = 0; i < 4000; i++) {
        const bool wide = i % 4 == 0;
        const double s = wide ? 0.4 : 0.1;
        const double x = normal(random), y = normal(random), z = normal(random);
        points.emplace_back((wide ? 0.6 : 0) + s * x, s * y, s * z);
    }
    const Mixture m = fitMixture(points, 2, 200, 1);
    const std::size_t wide = m.weights[0] < m.weights[1] ? 0 : 1;
    EXPECT_NEAR(m.weights[wide], 0.25, 0.03);
    EXPECT_LT((m.means[wide] - Eigen::Vector3d(0.6, 0, 0)).norm(), 0.06);
    EXPECT_LT((m.covariances[wide] - 0.16 * Eigen::Matrix3d::Identity()).norm(), 0.03);
    EXPECT_LT((m.covariances[1 - wide] - 0.01 * Eigen::Matrix3d::Identity()).norm(), 0.003);
}

TEST(CellsOnRay, AreThoseItPasses) {
    const std::vector<CellIndex> expected{{0, 0, -1}, {1, 0, -1}, {1, 1, -1}, {2, 1, -1}};
    EXPECT_EQ(cellsOnRay({{0.5, 0.5, -0.5}, {2.7, 1.6, -0.5}}, 1), expected);
    EXPECT_EQ(cellsOnRay({{2.7, 1.6, -0.5}, {0.5, 0.5, -0.5}}, 1),
              (std::vector<CellIndex>(expected.rbegin(), expected.rend())));
    EXPECT_EQ(cellsOnRay({{0.5, 0.5, 0.5}, {0.5, 0.5, 0.5}}, 1).size(), 1u);
}

TEST(GmmMap, TwoScansOfAWallGiveTheirLogOdds) {
    std::vector<Ray> scan;
    for (int i = -20; i <= 20; i++)
        for (int j = -20; j <= 20; j++)
            scan.push_back({{0, 0.025, 0.025}, {2.025, 0.025 + i * 0.01, 0.025 + j * 0.01}});
    GmmOptions o;
    o.components = 1, o.samples = 5000, o.hit = 0.9, o.miss = 0.25, o.highest = 0.999;
    GmmMap map(o);
    for (int i = 0; i < 2; i++) map.insert(scan);
    const auto twice = [](double p) { return p * p / (p * p + (1 - p) * (1 - p)); };
    EXPECT_NEAR(map.occupancy(2.025, 0.025, 0.025).value(), twice(0.9), 1e-6);
    EXPECT_NEAR(map.occupancy(1.025, 0.025, 0.025).value(), twice(0.25), 1e-6);
    EXPECT_FALSE(map.occupancy(2.125, 0.025, 0.025));
    EXPECT_FALSE(map.occupancy(-0.075, 0.025, 0.025));
}

struct Measured {
    const char* name;
    double auc, mse, all_auc, all_mse;
};

class La3dmScene : public testing::TestWithParam<Measured> {};

TEST_P(La3dmScene, ScoresAsLa3dmsOwnCode) {
    const char* data = std::getenv("AKIMAP_DATA");
    const std::string folder = std::string(data ? data : "") + "/la3dm/sim_structured/";
    if (!data || !std::filesystem::exists(folder + "truth_5cm.bt"))
        GTEST_SKIP() << "no la3dm in $AKIMAP_DATA";
    const Measured& m = GetParam();
    BgkOctoMap points;
    BgkLOctoMap lines;
    Rival& map = std::string(m.name) == "BGK" ? static_cast<Rival&>(points) : lines;
    for (int i = 1; i <= 12; i++)
        map.insert(app::readPcd(folder + "sim_structured_" + std::to_string(i) + ".pcd"));
    const auto e =
        app::evaluate([&](double x, double y, double z) { return map.occupancy(x, y, z); }, 0.05,
                      app::readTruth(folder + "truth_5cm.bt"), {{0, 0, 0}, {7.25, 10.2, 2.1}});
    EXPECT_NEAR(e.known.auc, m.auc, 0.003);
    EXPECT_NEAR(e.known.mse, m.mse, 0.003);
    EXPECT_NEAR(e.all.auc, m.all_auc, 0.003);
    EXPECT_NEAR(e.all.mse, m.all_mse, 0.003);
}

INSTANTIATE_TEST_SUITE_P(Rivals, La3dmScene,
                         testing::Values(Measured{"BGK", 0.887, 0.114, 0.831, 0.153},
                                         Measured{"BGKL", 0.897, 0.090, 0.838, 0.127}),
                         [](const auto& test) { return std::string(test.param.name); });
