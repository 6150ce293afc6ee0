// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <gtest/gtest.h>

#include "HitCounter.h"
#include "estimators/estimators.h"
#include "estimators/options.h"
#include "grid/BlockGrid.h"
#include "random_scans.h"
#include "same_blocks.h"

using namespace akimap;

namespace {

std::string messageOf(ScanEstimator& estimator, const InsertionParameters& p, BlockGrid& grid) {
    InsertionStats stats;
    try {
        insertScan(estimator, {test::randomScan(1, 50), 0}, p, grid, stats);
    } catch (const std::invalid_argument& e) {
        EXPECT_EQ(stats.rays, 0u);
        EXPECT_TRUE(grid.isEmpty());
        return e.what();
    }
    return "";
}

}  // namespace

TEST(Estimators, AThirdOneNeedsNothingButTheInterface) {
    test::HitCounter counter(2);
    BlockGrid grid(0.1);
    InsertionStats stats;
    const std::vector<Ray> rays{{{0, 0, 0}, {1.05, 0.05, 0.05}}, {{0, 0, 0}, {-1.05, 0.05, 0.05}}};
    EXPECT_TRUE(insertScan(counter, {rays, 0}, {}, grid, stats));
    EXPECT_TRUE(insertScan(counter, {rays, 1}, {}, grid, stats));
    EXPECT_FALSE(insertScan(counter, {{}, 2}, {}, grid, stats));
    std::size_t n = 0;
    grid.forEachCell([&](const CellIndex& c, float alpha, float beta) {
        n++;
        EXPECT_TRUE((c == CellIndex{10, 0, 0}) || (c == CellIndex{-11, 0, 0}));
        EXPECT_EQ(alpha, 4);
        EXPECT_EQ(beta, 0);
    });
    EXPECT_EQ(n, 2u);
    EXPECT_EQ(stats.scans, 2u);
    EXPECT_EQ(stats.points, 4u);
}

TEST(Estimators, ItsOwnChecksRefuseBeforeAnythingChanges) {
    BlockGrid grid(0.1);
    test::HitCounter counter(-1);
    EXPECT_EQ(messageOf(counter, {}, grid), "weight: must be > 0");
}

TEST(Estimators, AreEachMadeByName) {
    for (const char* name : enumNames(Estimator{})) {
        InsertionParameters p;
        p.estimator = std::string_view(name) == "paper" ? Estimator::paper : Estimator::surface;
        BlockGrid grid(0.1);
        InsertionStats stats;
        EXPECT_TRUE(
            insertScan(*makeEstimator(p.estimator), {test::randomScan(1, 300), 0}, p, grid, stats));
        EXPECT_GT(grid.countCells(), 100u);
    }
}

TEST(Estimators, OptionsOfTheOtherAreNotComplainedOf) {
    BlockGrid grid(0.05);
    InsertionParameters p;
    p.max_range = 1e9;  // far more than 1e6 sampling distances, which surface does not take
    EXPECT_EQ(messageOf(*makeEstimator(Estimator::surface), p, grid = BlockGrid(0.05)), "");
    p.estimator = Estimator::paper;
    grid = BlockGrid(0.05);
    EXPECT_NE(messageOf(*makeEstimator(Estimator::paper), p, grid).find("sampling_distance"),
              std::string::npos);
}

TEST(Estimators, SetButIdleOptionsAreNamed) {
    InsertionParameters p;
    EXPECT_TRUE(idleOptions(p).empty());
    p.sampling_distance = 0.25;
    p.bandwidth = Bandwidth::isotropic;
    p.free_radius = 0.3;
    EXPECT_EQ(idleOptions(p), (std::vector<std::string>{"sampling_distance", "bandwidth"}));
    p.estimator = Estimator::paper;
    EXPECT_EQ(idleOptions(p), std::vector<std::string>{"free_radius"});
}

TEST(Estimators, OptionsInForceAreThoseUsed) {
    InsertionParameters p;
    p.free_radius = 5;
    const auto surface = makeEstimator(Estimator::surface);
    EXPECT_NEAR(surface->inForce(p, 0.02).free_radius, 0.16, 1e-12);  // 8 cells
    p.free_radius = 0.01;
    EXPECT_NEAR(surface->inForce(p, 0.02).free_radius, 0.03, 1e-12);  // 1.5 cells
    EXPECT_EQ(surface->inForce(p, 1.0).surface_range, 1);
    const auto paper = makeEstimator(Estimator::paper);
    EXPECT_EQ(paper->inForce(p, 0.1).search_range_origin, 0.1);
    EXPECT_NEAR(paper->inForce(p, 0.05).covariance_floor, 0.001, 1e-15);
    EXPECT_EQ(paper->inForce(p, 0.1).scale_min_length, 0.1);

    // Using them instead gives the same map: they are what is used.
    p = {};
    p.free_radius = 5;
    for (const Estimator e : {Estimator::surface, Estimator::paper}) {
        const auto estimator = makeEstimator(e);
        BlockGrid given(0.1), in_force(0.1);
        InsertionStats stats;
        const auto rays = test::randomScan(3, 300);
        insertScan(*estimator, {rays, 0}, p, given, stats);
        insertScan(*estimator, {rays, 0}, estimator->inForce(p, 0.1), in_force, stats);
        EXPECT_EQ(test::blockBits(given), test::blockBits(in_force));
    }
}
