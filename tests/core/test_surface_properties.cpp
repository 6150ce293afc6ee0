// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "estimators/estimators.h"
#include "estimators/surface/cell_evidence.h"
#include "grid/BlockGrid.h"

using namespace akimap;

namespace {

using Point = std::array<double, 3>;

/** A map of 1 m cells, so that places are in cells. */
struct Map {
    InsertionParameters p;
    BlockGrid grid{1};
    uint64_t scans = 0;

    Map() { p.max_range = 200, p.surface_range = 10, p.free_radius = 4; }
    void insert(const std::vector<Ray>& rays) {
        InsertionStats stats;
        insertScan(*makeEstimator(Estimator::surface), {rays, scans++}, p, grid, stats);
    }
    /** What a cell has got. */
    [[nodiscard]] CellSumsRow sums(const CellIndex& c) const {
        CellSumsRow row{};
        const Block* block = grid.find(BlockGrid::blockOf(c));
        if (!block || !block->surface) return row;
        const auto i = static_cast<std::size_t>(BlockGrid::offsetOf(c));
        const SurfaceSums& s = *block->surface;
        row.weight[0] = s.weight[i], row.place[0] = s.place[i];
        row.square[0] = s.square[i], row.through[0] = s.through[i];
        return row;
    }
    [[nodiscard]] float weight(const CellIndex& c) const { return sums(c).weight[0]; }
    [[nodiscard]] float through(const CellIndex& c) const { return sums(c).through[0]; }
    [[nodiscard]] float mean(const CellIndex& c) const {
        const CellSumsRow s = sums(c);
        return s.place[0] / s.weight[0];
    }
    /** Probability, without a prior; -1 where nothing is known. */
    [[nodiscard]] float occupancy(const CellIndex& c) const {
        const Block* block = grid.find(BlockGrid::blockOf(c));
        if (!block) return -1;
        const auto i = static_cast<std::size_t>(BlockGrid::offsetOf(c));
        const float all = block->alpha[i] + block->beta[i];
        return all > 0 ? block->alpha[i] / all : -1;
    }
};

/** Rays to a plane n p = distance within a square of so many cells about its point nearest to the
 * map's origin, with a cell's tenth of noise along them. */
struct Plane {
    Point n, u, v;
    double distance;

    [[nodiscard]] Point at(double a, double b, double height = 0) const {
        Point p{};
        for (std::size_t i = 0; i < 3; i++) p[i] = n[i] * (distance + height) + u[i] * a + v[i] * b;
        return p;
    }
    [[nodiscard]] double heightOf(const CellIndex& c) const {
        return n[0] * (c.x + 0.5) + n[1] * (c.y + 0.5) + n[2] * (c.z + 0.5) - distance;
    }
    [[nodiscard]] std::vector<Ray> seenFrom(const Point& sensor, double half_side,
                                            unsigned seed) const {
        std::mt19937 random(seed);
        std::normal_distribution<double> noise(0, 0.1);
        std::vector<Ray> rays;
        for (double a = -half_side; a <= half_side; a += 0.71)
            for (double b = -half_side; b <= half_side; b += 0.71) {
                Ray r{sensor, at(a, b)};
                r.end = placeAlong(r, 1 + noise(random) / lengthOf(r));
                rays.push_back(r);
            }
        return rays;
    }
};

Plane planeAcross(const Point& direction, double distance) {
    const auto cross = [](const Point& a, const Point& b) {
        return Point{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                     a[0] * b[1] - a[1] * b[0]};
    };
    const auto unit = [](Point p) {
        const double length = std::hypot(p[0], p[1], p[2]);
        for (double& v : p) v /= length;
        return p;
    };
    const Point n = unit(direction), u = unit(cross(n, {0.3, 0.5, 0.8}));
    return {n, u, cross(n, u), distance};
}

class SeenPlane : public testing::TestWithParam<Point> {};

}  // namespace

TEST_P(SeenPlane, LiesWhereItIsAndIsSeenFromItsFront) {
    constexpr double kSide = 15;
    const Plane plane = planeAcross(GetParam(), 3.3);
    Map map;
    unsigned seed = 1;
    for (const double a : {-12.0, 0.0, 9.0})
        for (const double height : {14.0, 25.0})
            map.insert(plane.seenFrom(plane.at(a, a / 2, height), kSide, seed++));
    std::size_t through = 0, before = 0, behind = 0;
    double worst = 0;
    map.grid.forEachCell([&](const CellIndex& c, float, float) {
        const double height = plane.heightOf(c);
        if (std::hypot(c.x, c.y, c.z) > kSide - 3) return;  // at the square's rim
        const auto mean = static_cast<double>(map.mean(c));
        if (std::abs(height) < 0.5) {
            through++;
            worst = std::max(worst, std::abs(mean - height));
            EXPECT_TRUE(height > 0.3 || map.occupancy(c) > 0.5f) << height;
        } else if (height > 1.5 && height < 6) {
            before++;
            EXPECT_LT(map.occupancy(c), 0.1f) << height;
        } else if (height < -0.5 && height > -1.5) {
            behind++;
            EXPECT_LT(mean, -0.3);
        }
    });
    EXPECT_GT(through, 300u);
    EXPECT_GT(before, 300u);
    EXPECT_GT(behind, 300u);
    EXPECT_LT(worst, 0.1);
}

INSTANTIATE_TEST_SUITE_P(All, SeenPlane,
                         testing::Values(Point{0, 0, 1}, Point{-1, 0, 0}, Point{1, 2, 0},
                                         Point{-3, 1, -2}, Point{1, 1, 1}));

namespace {

// Along x at the same height: two returns from a thing, and a ray that passes it.
const Ray kToThing{{40.5, 4.5, 4.5}, {12.5, 4.5, 4.5}}, kAgain{{40.5, 4.5, 4.5}, {12.6, 4.5, 4.5}},
    kPast{{40.5, 4.5, 4.5}, {2.5, 4.5, 4.5}};

}  // namespace

TEST(SurfaceCells, WithReturnsAndPassingRaysTakeBoth) {
    Map map, alone;
    map.insert({kToThing, kAgain, kPast});
    alone.insert({kToThing, kAgain});
    const CellIndex c{12, 4, 4};
    EXPECT_FLOAT_EQ(map.through(c), 1.0f / 3);
    EXPECT_EQ(alone.through(c), 0);
    EXPECT_EQ(map.weight(c), alone.weight(c));
    EXPECT_EQ(map.weight(c), 1);
}

TEST(SurfaceCells, ThatRaysPassAndNoneEndsInTakeAFifth) {
    Map map, alone;
    map.insert({kToThing, kPast});
    alone.insert({kToThing});
    for (const CellIndex c : {CellIndex{11, 4, 4}, CellIndex{13, 4, 4}}) {
        EXPECT_GT(alone.weight(c), 0.5f);
        EXPECT_EQ(alone.through(c), 0);
        EXPECT_FLOAT_EQ(map.weight(c), 0.2f * alone.weight(c));
        EXPECT_EQ(map.through(c), 1);
    }
    const CellIndex beside{12, 5, 4};
    EXPECT_EQ(map.weight(beside), alone.weight(beside));
}

TEST(SurfaceCells, CountEachRayOnceWhicheverWayItEntersABlock) {
    for (const bool mirrored : {false, true}) {
        const auto place = [&](double x) { return Point{mirrored ? 16 - x : x, 4.5, 4.5}; };
        Map map;
        // The second ray passes the first one's cell: near its own hit, at a block's face.
        map.insert({{place(-20.5), place(7.5)}, {place(-20.5), place(9.8)}});
        EXPECT_FLOAT_EQ(map.through({mirrored ? 8 : 7, 4, 4}), 0.5f) << mirrored;
    }
}

TEST(SurfaceCells, KnowTheirReturnsHoweverFarTheirPatchMoved) {
    std::vector<Ray> rays;
    const Point sensor{4.5, 4.5, 30};
    for (const double x : {-3.5, 4.5, 12.5})
        for (const double y : {-3.5, 4.5, 12.5}) rays.push_back({sensor, {x, y, 5.4}});
    rays.push_back({sensor, {4.5, 4.5, 8.3}});  // moves down to 5.8, out of reach of its cell
    Map map;
    map.p.surface_range = 20;
    map.insert(rays);
    EXPECT_EQ(map.weight({4, 4, 8}), 0);
    EXPECT_FLOAT_EQ(map.through({4, 4, 8}), 0.5f);
}

TEST(SurfaceForgetting, PassingRaysClearWhatIsGone) {
    const Plane wall = planeAcross({0, 0, 1}, 12.4), behind = planeAcross({0, 0, 1}, 2.4);
    const Point sensor{0.3, 0.2, 40.3};
    Map map;
    constexpr int kScans = 20;
    std::vector<CellIndex> cells;
    for (int x = -5; x <= 5; x++)
        for (int y = -5; y <= 5; y++) cells.push_back({x, y, 12});
    for (unsigned n = 0; n < kScans; n++) map.insert(wall.seenFrom(sensor, 10, n));
    for (const CellIndex& c : cells) EXPECT_GT(map.occupancy(c), 0.9f);
    for (unsigned n = 0; n < kScans; n++) map.insert(behind.seenFrom(sensor, 13, n));
    for (const CellIndex& c : cells) EXPECT_LT(map.occupancy(c), 0.5f) << c.x << " " << c.y;
}

TEST(SurfaceForgetting, EvidenceIsBounded) {
    const Plane wall = planeAcross({0.2, 0, 1}, 12.4);
    Map map;
    map.p.max_evidence = 5;
    float most = 0;
    for (unsigned n = 0; n < 8; n++) {
        map.insert(wall.seenFrom({0.3, 0.2, 40.3}, 10, n));
        map.grid.forEachCell([&](const CellIndex&, float alpha, float beta) {
            most = std::max(most, alpha + beta);
        });
    }
    EXPECT_LE(most, 5 * 1.000001f);
    EXPECT_GT(most, 4.9f);
}

TEST(CellEvidence, NormalDistribution) {
    for (int i = -8000; i <= 8000; i++) {
        const float z = static_cast<float>(i) / 1000;
        const double exact = std::erfc(-static_cast<double>(z) / std::sqrt(2.0)) / 2;
        Row row{};
        row += z;
        const Row p = normalDistribution(row);
        for (int lane = 0; lane < 8; lane++)
            ASSERT_NEAR(static_cast<double>(p[lane]), exact, 3e-7) << z;
    }
}
