// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
//
// Rays of a scan cast through maps that it never got: small worlds whose figures are known exactly.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <random>

#include "evaluation/contest/beam.h"
#include "evaluation/contest/faithfulness.h"
#include "evaluation/contest/next_scan.h"

using namespace akimap;
using namespace akimap::app;

namespace {

constexpr double kCell = 0.1;  // [m]
constexpr int kWall = 20;      // the wall's cells begin at x = 2 m

std::array<double, 3> centerOf(const CellIndex& c) {
    return {(c.x + 0.5) * kCell, (c.y + 0.5) * kCell, (c.z + 0.5) * kCell};
}

/** Rays from cells at x = 0 to the cell at x = `cell`, straight ahead, one for each y in [0, 10).
 */
std::vector<Ray> raysTo(int cell) {
    std::vector<Ray> rays;
    for (int y = 0; y < 10; y++) rays.push_back({centerOf({0, y, 0}), centerOf({cell, y, 0})});
    return rays;
}

/** Known to be free but for one plane of cells. */
OccupancyCells wallAt(int cell) {
    OccupancyCells map = noCells(kCell);
    for (int x = 0; x < 40; x++)
        for (int y = -1; y < 11; y++)
            for (int z = -1; z < 2; z++) map[{x, y, z}] = x == cell ? 0.9f : 0.1f;
    return map;
}

ReturnCounts returnsOf(const std::vector<Ray>& rays) {
    ReturnCounts counts(kCell);
    countReturns(rays, counts);
    return counts;
}

RayShares sharesOf(const OccupancyCells& map, const std::vector<Ray>& rays,
                   const ReturnCounts& returns) {
    RayTally tally;
    tally.add(rays, castRays(map, returns, rays));
    EXPECT_EQ(tally.rays(), rays.size());
    const RayShares s = tally.shares();
    EXPECT_NEAR(s.near3 + s.early + s.late + s.miss, 1, 1e-12);
    return s;
}
RayShares sharesOf(const OccupancyCells& map, const std::vector<Ray>& rays) {
    return sharesOf(map, rays, returnsOf(rays));
}

}  // namespace

// Walking ------------------------------------------------------------------------------------

TEST(WalkCells, EveryPlaceOfABeamIsInTheCellThatIsVisited) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> place(-2, 2);
    for (int i = 0; i < 300; i++) {
        const auto at = [&] {
            return std::array<double, 3>{place(random), place(random), place(random)};
        };
        const Beam beam(Ray{at(), at()});
        double end = 0;
        walkCells(beam, beam.length, kCell, [&](const CellIndex& c, double enter, double leave) {
            EXPECT_EQ(enter, end) << "a gap";
            EXPECT_GE(leave, enter);
            end = leave;
            const auto middle = beam.at(0.5 * (enter + leave));
            if (leave - enter < 1e-9) return true;  // through a corner
            EXPECT_EQ(std::floor(middle[0] / kCell), c.x);
            EXPECT_EQ(std::floor(middle[1] / kCell), c.y);
            EXPECT_EQ(std::floor(middle[2] / kCell), c.z);
            return true;
        });
        EXPECT_GE(end, beam.length);
    }
}

TEST(WalkCells, AlongAnAxisAndBackwards) {
    std::vector<int> cells;
    const Beam beam(Ray{{0.25, 0.05, 0.05}, {-0.15, 0.05, 0.05}});
    walkCells(beam, beam.length, kCell, [&](const CellIndex& c, double, double) {
        cells.push_back(c.x);
        return c.x > -2;
    });
    EXPECT_EQ(cells, (std::vector<int>{2, 1, 0, -1, -2}));
}

// Casting ------------------------------------------------------------------------------------

TEST(NextScan, AWallWhereTheMapHasIt) {
    const RayShares s = sharesOf(wallAt(kWall), raysTo(kWall));
    EXPECT_EQ(s.near1, 1);
    EXPECT_EQ(s.near3, 1);
    EXPECT_EQ(s.miss, 0);
    EXPECT_NEAR(s.depth_error_median, 0, 1e-6) << "midway through the cell";
    EXPECT_NEAR(s.depth_error_90, 0, 1e-6);
}

TEST(NextScan, AMapShiftedByWholeCells) {
    for (const int shift : {-4, -3, -2, -1, 1, 2, 3, 4, 5}) {
        const RayShares s = sharesOf(wallAt(kWall + shift), raysTo(kWall));
        const int cells = std::abs(shift);
        EXPECT_EQ(s.near1, cells <= 1) << shift;
        EXPECT_EQ(s.near3, cells <= 3) << shift;
        EXPECT_EQ(s.early, shift == -4) << shift;
        EXPECT_EQ(s.phantom, shift == -4) << shift;
        EXPECT_EQ(s.late, shift == 4) << shift;
        EXPECT_EQ(s.miss, shift == 5) << shift << ": cast to four cells behind the return";
        if (shift < 5)
            EXPECT_NEAR(s.depth_error_median, cells * kCell, 1e-6);
        else
            EXPECT_TRUE(std::isnan(s.depth_error_median));
    }
}

TEST(NextScan, AHoleIsAMissAndUnknownWithoutEvidence) {
    OccupancyCells map = wallAt(kWall);
    map[{kWall, 3, 0}] = 0.5f;  // not above it
    map[{kWall, 6, 0}] = std::nanf("");
    const RayShares s = sharesOf(map, raysTo(kWall));
    EXPECT_NEAR(s.near1, 0.8, 1e-12);
    EXPECT_NEAR(s.miss, 0.2, 1e-12);
    EXPECT_NEAR(s.unknown, 0.1, 1e-12);
    const RayShares nothing = sharesOf(noCells(kCell), raysTo(kWall));
    EXPECT_EQ(nothing.miss, 1);
    EXPECT_EQ(nothing.unknown, 1);
}

/** A post at x = 10, y in [5, 10) before the wall; the rays at y < 5 pass beside it. */
TEST(NextScan, AnEdgeOneCellTooWideIsGrazedAndTwoIsAPhantom) {
    std::vector<Ray> rays = raysTo(kWall);
    for (std::size_t y = 5; y < 10; y++) rays[y].end = centerOf({10, static_cast<int>(y), 0});
    const auto widenedBy = [&](int cells) {
        OccupancyCells map = wallAt(kWall);
        for (int y = 5 - cells; y < 10; y++) map[{10, y, 0}] = 0.9f;
        return sharesOf(map, rays);
    };
    EXPECT_EQ(widenedBy(0).near1, 1);
    EXPECT_NEAR(widenedBy(1).early, 0.1, 1e-12);
    EXPECT_EQ(widenedBy(1).phantom, 0);
    EXPECT_NEAR(widenedBy(2).early, 0.2, 1e-12);
    EXPECT_NEAR(widenedBy(2).phantom, 0.1, 1e-12) << "two cells from the post's returns";
}

TEST(NextScan, ReturnsOfAnyHeldOutScanMakeASurface) {
    const std::vector<Ray> rays = raysTo(kWall);
    const RayShares alone = sharesOf(wallAt(10), rays);
    EXPECT_EQ(alone.phantom, 1);
    std::vector<Ray> both = rays;
    for (const Ray& ray : raysTo(11)) both.push_back(ray);
    const RayShares seen = sharesOf(wallAt(10), rays, returnsOf(both));
    EXPECT_EQ(seen.early, 1);
    EXPECT_EQ(seen.phantom, 0);
}

TEST(NextScan, TheDepthIsMidwayThroughTheCellOnASlantedRay) {
    OccupancyCells map = noCells(kCell);
    map[{10, 5, 0}] = 0.9f;
    // Through y = 0.5 at x = 1.04 and out at y = 0.53, x = 1.1: 3 by 6 cm, then midway.
    const Ray ray{{0.04, 0, 0.05}, {1.24, 0.6, 0.05}};
    const auto outcome = castRays(map, returnsOf({ray}), {ray}).front();
    EXPECT_NEAR(outcome.depth, std::hypot(1.03, 0.515), 1e-6);
    EXPECT_EQ(outcome.end, RayEnd::near3);
}

TEST(NextScan, DoesNotDependOnThreads) {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> place(-1, 1);
    OccupancyCells map = noCells(kCell);
    std::vector<Ray> rays;
    for (int i = 0; i < 2000; i++) {
        const auto at = [&] {
            return std::array<double, 3>{place(random), place(random), place(random)};
        };
        rays.push_back({at(), at()});
        map[map.cellAt(at())] = i % 5 ? 0.2f : 0.8f;
    }
    const ReturnCounts returns = returnsOf(rays);
    const auto many = castRays(map, returns, rays);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const auto single = castRays(map, returns, rays);
    std::array<int, 7> kinds{};
    for (std::size_t i = 0; i < rays.size(); i++) {
        EXPECT_EQ(many[i].end, single[i].end);
        EXPECT_TRUE(many[i].depth == single[i].depth ||
                    (std::isnan(many[i].depth) && std::isnan(single[i].depth)));
        kinds[static_cast<std::size_t>(many[i].end)]++;
    }
    for (const int kind : kinds) EXPECT_GT(kind, 0) << "a kind of end that no ray has";
}

// Faithfulness -------------------------------------------------------------------------------

TEST(Faithfulness, OfTheCellsWithThreeReturnsAndMore) {
    std::vector<Ray> rays;
    const auto add = [&](const CellIndex& c, int times) {
        for (int i = 0; i < times; i++) rays.push_back({{0, 0, 0}, centerOf(c)});
    };
    add({10, 0, 0}, 3), add({10, 4, 0}, 5), add({10, 8, 0}, 3), add({10, 12, 0}, 4);
    add({10, 16, 0}, 2);  // too few to count
    OccupancyCells map = noCells(kCell);
    map[{10, 0, 0}] = 0.9f;                                     // occupied
    map[{10, 4, 0}] = 0.2f;                                     // forgotten, and
    map[{11, 5, -1}] = 0.6f;                                    // remembered a corner away
    map[{10, 8, 0}] = 0.2f;                                     // forgotten, and
    map[{10, 10, 0}] = 0.9f;                                    // remembered too far away
    const Faithfulness f = faithfulness(map, returnsOf(rays));  // nothing known of the fourth
    EXPECT_EQ(f.cells, 4u);
    EXPECT_EQ(f.occupied, 1u);
    EXPECT_EQ(f.occupied_nearby, 2u);
    EXPECT_EQ(f.share(), 0.25);
    EXPECT_EQ(f.shareNearby(), 0.5);
}

// The rival ----------------------------------------------------------------------------------

TEST(Tsdf, AcrossAPlane) {
    constexpr double kPlane = 1.03;
    TsdfMap map(kCell);
    std::vector<Ray> rays;
    for (int y = 0; y < 10; y++) {
        const auto from = centerOf({0, y, 0});
        rays.push_back({from, {kPlane, from[1], from[2]}});
    }
    map.insert(rays);
    for (int x = 0; x <= 13; x++) {  // the last one that begins less than 4 cells behind
        const double distance = kPlane - (x + 0.5) * kCell;
        const auto found = map.distance({x, 5, 0});
        ASSERT_TRUE(found) << x;
        EXPECT_NEAR(*found, std::min(distance, 4 * kCell), 1e-6) << x;
    }
    EXPECT_FALSE(map.distance({14, 5, 0})) << "more than 4 cells behind";
    EXPECT_FALSE(map.distance({5, 5, 1})) << "beside the rays";
    const OccupancyCells cells = cellsOf(map);
    OccupancyCells::Reader reader(cells);
    for (int x = 0; x <= 13; x++) {
        const double distance = kPlane - (x + 0.5) * kCell;
        EXPECT_EQ(isOccupied(reader[{x, 5, 0}]), distance <= 0.05 && distance > -0.2) << x;
    }
    EXPECT_EQ(sharesOf(cells, rays).near1, 1);
}

TEST(Tsdf, ItsMeanIsWeightedBehindTheReturn) {
    TsdfMap map(kCell);
    const auto from = centerOf({0, 0, 0});
    map.insert({{from, {1.05, from[1], from[2]}}});  // 1 m
    map.insert({{from, {1.35, from[1], from[2]}}});
    // The cell centred at 1.25 m lies 0.2 m behind the first return, with half the weight, and
    // 0.1 m before the second.
    EXPECT_NEAR(map.distance({12, 0, 0}).value(), (0.5 * -0.2 + 0.1) / 1.5, 1e-6);
}
