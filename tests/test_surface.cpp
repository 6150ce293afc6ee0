// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
// The surface estimator: what a scan says of surfaces and of free space.

#include <akimap/AkiMap.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "grid/BlockGrid.h"
#include "random_scans.h"
#include "same_map.h"

using namespace akimap;

namespace {

constexpr double kDegree = 3.14159265358979323846 / 180;
constexpr double kFloor = -0.02;  // [m] within the cells [-0.05, 0)

/** A sensor 0.6 m above a floor: rays 1 degree apart, which meet it 1 to 6 m away, at down to 6
 * degrees. */
std::vector<Ray> grazingScan(double x = 0) {
    std::vector<Ray> rays;
    for (double down = 6; down < 31; down += 1)
        for (double turn = -40; turn <= 40; turn += 1) {
            const double reach = (0.6 - kFloor) / std::tan(down * kDegree);
            rays.push_back(
                {{x, 0, 0.6},
                 {x + reach * std::cos(turn * kDegree), reach * std::sin(turn * kDegree), kFloor}});
        }
    return rays;
}

/** Of the floor where the rings of hits are at most 0.3 m apart, the share whose cells are
 * occupied in the layer at this height [m]. */
double occupiedShare(const AkiMap& map, double z) {
    int occupied = 0, all = 0;
    for (double x = 1.225; x < 3.2; x += 0.05)
        for (double y = -0.575; y < 0.6; y += 0.05) {
            all++;
            occupied += map.occupancy(x, y, z).value_or(0) > 0.5;
        }
    return static_cast<double>(occupied) / all;
}

AkiMap mapOf(const std::vector<std::vector<Ray>>& scans) {
    AkiMap map(0.05);
    for (const auto& scan : scans) map.insertRays(scan);
    return map;
}

}  // namespace

TEST(Surface, AFloorSeenAtGrazingAnglesIsThinAndComplete) {
    const AkiMap map = mapOf({grazingScan()});
    EXPECT_GT(occupiedShare(map, kFloor), 0.99);
    for (const double z : {-0.275, 0.075, 0.125, 0.175}) EXPECT_EQ(occupiedShare(map, z), 0) << z;
    int free = 0, all = 0;
    for (double x = 1.225; x < 3.2; x += 0.05, all++)
        free += map.occupancy(x, 0.025, 0.125).value_or(1) < 0.2;
    EXPECT_EQ(free, all);
}

TEST(Surface, RaysAboveAFloorDoNotEatIt) {
    AkiMap map = mapOf({grazingScan()});
    std::vector<Ray> above;  // to a wall at x = 7, from 0.6 down to 0.15 m above the floor
    for (double y = -1; y <= 1; y += 0.05)
        for (double z = 0.15; z < 0.6; z += 0.05) above.push_back({{0, 0, 0.6}, {7, y, z}});
    for (int i = 0; i < 5; i++) map.insertRays(grazingScan(0.02 * i)), map.insertRays(above);
    EXPECT_GT(occupiedShare(map, kFloor), 0.97);
}

TEST(Surface, BehindAWallNothingIsFree) {
    std::vector<Ray> rays;
    for (double y = -1; y <= 1; y += 0.08)
        for (double z = -1; z <= 1; z += 0.08) rays.push_back({{0, 0, 0}, {2.02, y, z}});
    const AkiMap map = mapOf({rays});
    for (double y = -0.8; y < 0.8; y += 0.05)
        for (double x = 2.225; x < 3; x += 0.05)
            EXPECT_FALSE(map.occupancy(x, y + 0.001, 0.001)) << x << " " << y;
    EXPECT_LT(map.occupancy(1.8, 0.001, 0.001).value(), 0.05);
    EXPECT_GT(map.occupancy(2.02, 0.001, 0.001).value(), 0.9);
}

/** Kernels reach far past the last hits: their tails are no walls where nothing else is known. */
TEST(Surface, TheTailsOfKernelsAreNoWalls) {
    std::vector<Ray> rays;
    for (double y = -0.5; y <= 0.5; y += 0.1)
        for (double z = -0.5; z <= 0.5; z += 0.1) rays.push_back({{0, 0, 0}, {2.02, y, z}});
    const AkiMap map = mapOf({rays});
    double farthest = 0;
    map.forEachCell([&](const akimap::Cell& cell_at) {
        const mrpt::math::TPoint3D p(cell_at.x, cell_at.y, cell_at.z);
        const akimap::CellState& s = cell_at.state;
        if (s.occupancy() > 0.5) farthest = std::max({farthest, std::abs(p.y), std::abs(p.z)});
    });
    EXPECT_GT(farthest, 0.5);
    EXPECT_LT(farthest, 0.5 + 0.2);
}

TEST(Surface, AScanIsAtMostOneObservationOfACell) {
    const AkiMap map = mapOf({test::randomScan(3, 3000)});
    ASSERT_GT(map.cellCount(), 1000u);
    map.grid().forEachCell([](const CellIndex&, float alpha, float beta) {
        ASSERT_LE(alpha, 2);  // a surface counts twice
        ASSERT_LE(beta, 4);   // a ray that passes, three times
    });
}

TEST(Surface, MirroredScansGiveMirroredMaps) {
    const auto scan = test::randomScan(5, 1500);
    auto mirrored = scan;
    for (Ray& r : mirrored) r.origin[1] = -r.origin[1], r.end[1] = -r.end[1];
    const AkiMap map = mapOf({scan}), mirror = mapOf({mirrored});
    EXPECT_EQ(map.cellCount(), mirror.cellCount());
    std::size_t cells = 0, same = 0;
    map.forEachCell([&](const akimap::Cell& cell_at) {
        const mrpt::math::TPoint3D p(cell_at.x, cell_at.y, cell_at.z);
        const akimap::CellState& s = cell_at.state;
        const auto other = mirror.cell(p.x, -p.y, p.z);
        cells++;
        same += other && std::abs(other->alpha - s.alpha) < 1e-3 &&
                std::abs(other->beta - s.beta) < 1e-3;
    });
    EXPECT_GT(static_cast<double>(same), 0.999 * static_cast<double>(cells));
}

TEST(Surface, TheSameBitsForAnyNumberOfThreads) {
    std::string first;
    for (const uint32_t threads : {1u, 2u, 3u, 0u}) {
        AkiMap map(0.05);
        map.insertionOptions.threads = threads;
        for (unsigned seed = 1; seed <= 3; seed++) map.insertRays(test::randomScan(seed, 1500));
        if (first.empty()) first = test::cellsFingerprint(map);
        EXPECT_EQ(test::cellsFingerprint(map), first) << threads;
    }
}

TEST(Surface, OneHitAloneIsASmallBallAndItsRayIsFree) {
    const AkiMap map = mapOf({{Ray{{0.01, 0.01, 0.01}, {3.02, 0.01, 0.01}}}});
    EXPECT_GT(map.occupancy(3.02, 0.01, 0.01).value(), 0.9);
    for (double x = 0.1; x < 2.8; x += 0.05)
        EXPECT_LT(map.occupancy(x, 0.01, 0.01).value(), 0.1) << x;
    EXPECT_FALSE(map.occupancy(1, 0.4, 0.01));
}

/** What this scan gave before there was another estimator. Sums, as processors round differently.
 */
TEST(PaperPreset, IsWhatItWas) {
    AkiMap map(0.05);
    map.insertionOptions.estimator = Estimator::paper;
    for (unsigned seed = 1; seed <= 3; seed++) map.insertRays(test::randomScan(seed, 1000));
    double alpha = 0, beta = 0;
    map.grid().forEachCell([&](const CellIndex&, float a, float b) { alpha += a, beta += b; });
    EXPECT_EQ(map.stats().samples_occupied, 2360u);
    EXPECT_EQ(map.stats().samples_free, 10360u);
    EXPECT_NEAR(static_cast<double>(map.cellCount()), 71828, 2);
    EXPECT_NEAR(alpha, 2683490.017, 1e-5 * alpha);
    EXPECT_NEAR(beta, 22524733.15, 1e-5 * beta);
}
