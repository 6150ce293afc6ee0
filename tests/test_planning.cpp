// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
// What planners ask: kinds of cells, rays, swept spheres, surface normals.

#include <akimap/queries.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace akimap;
using mrpt::math::TPoint3D;
using mrpt::math::TVector3D;

namespace {

constexpr double kWall = 2.025;  // the middle of a cell

/** A wall across x, seen from the origin. */
AkiMap wall() {
    AkiMap map(0.05);
    std::vector<Ray> scan;
    for (int i = -40; i <= 40; i++)
        for (int j = -40; j <= 40; j++)
            scan.push_back({{0.025, 0.025, 0.025}, {kWall, 0.025 * i, 0.025 * j}});
    for (int n = 0; n < 3; n++) map.insertRays(scan);
    return map;
}

TEST(CellKind, IsToldByTheShareOfTheEvidence) {
    EXPECT_EQ(kindOf(std::nullopt), CellKind::unknown);
    EXPECT_EQ(kindOf(CellState{4, 1}), CellKind::occupied);
    EXPECT_EQ(kindOf(CellState{1, 4}), CellKind::free);
    EXPECT_EQ(kindOf(CellState{3, 1}), CellKind::conflicting);
    EXPECT_EQ(kindOf(CellState{1, 3}), CellKind::conflicting);
}

TEST(ProbabilityAbove, IsTheBetaDistributions) {
    for (const double t : {0.1, 0.5, 0.9}) {
        EXPECT_NEAR(probabilityAbove({1, 1}, t), 1 - t, 1e-9);      // uniform
        EXPECT_NEAR(probabilityAbove({2, 1}, t), 1 - t * t, 1e-9);  // density 2 p
        EXPECT_NEAR(probabilityAbove({1, 3}, t), std::pow(1 - t, 3), 1e-9);
        EXPECT_NEAR(probabilityAbove({0.2, 7}, t) + probabilityAbove({7, 0.2}, 1 - t), 1, 1e-9);
    }
    EXPECT_NEAR(probabilityAbove({5000, 5000}, 0.5), 0.5, 1e-6);
    EXPECT_GT(probabilityAbove({5000, 2000}, 0.5), 1 - 1e-9);
    EXPECT_THROW(static_cast<void>(probabilityAbove({1, 1}, 0)), std::invalid_argument);
}

TEST(CastRay, StopsWhereItEntersTheSurface) {
    const AkiMap map = wall();
    for (const TVector3D& d : {TVector3D(1, 0, 0), TVector3D(3, 0.6, 0), TVector3D(2, -.5, .4)}) {
        const TPoint3D origin(0.325, 0.025, 0.025);
        const RayCast cast = castRay(map, origin, d, 8);
        ASSERT_TRUE(cast.hit);
        const TPoint3D at = origin + d * (*cast.hit / d.norm());
        EXPECT_NEAR(at.x, kWall - 0.025, 0.06);  // the face of the cell or of one before
        EXPECT_LT(cast.least_sure.place.x, at.x);
        EXPECT_LE(cast.least_sure.confidence, 1);
    }
    EXPECT_FALSE(castRay(map, {0.325, 0.025, 0.025}, {1, 0, 0}, 1.5).hit);
    EXPECT_FALSE(castRay(map, {0.325, 0.025, 0.025}, {-1, 0, 0}, 8).hit);
}

TEST(CastRay, TheUnknownIsTheLeastSurePlace) {
    const AkiMap map = wall();
    const RayCast away = castRay(map, {0.325, 0.025, 0.025}, {-1, 0, 0}, 3);
    EXPECT_EQ(away.least_sure.confidence, 0.5);
    const AkiMap nothing(0.05);
    const RayCast cast = castRay(nothing, {0.01, 0.01, 0.01}, {0, 0, 1}, 1);
    EXPECT_FALSE(cast.hit);
    EXPECT_EQ(cast.least_sure.confidence, 0.5);
}

/** Against asking at many places along the ray. */
TEST(CastRay, MeetsTheSameCellAsSmallSteps) {
    const AkiMap map = wall();
    for (int k = 0; k < 50; k++) {
        const TVector3D d(std::cos(0.02 * k - 0.5), std::sin(0.02 * k - 0.5), 0.011 * k - 0.27);
        const TPoint3D origin(0.3011 + 0.0013 * k, 0.0123, 0.0307);
        const RayCast cast = castRay(map, origin, d, 4);
        std::optional<double> hit;
        for (double t = 0; t < 4 && !hit; t += 1e-4) {
            const TPoint3D p = origin + d * (t / d.norm());
            if (map.occupancy(p.x, p.y, p.z).value_or(0) > 0.5) hit = t;
        }
        ASSERT_EQ(bool(cast.hit), bool(hit)) << k;
        EXPECT_NEAR(cast.hit.value_or(0), hit.value_or(0), 2e-3) << k;
    }
}

TEST(CastRay, RefusesWhatIsNoRay) {
    const AkiMap map(0.05);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(static_cast<void>(castRay(map, {nan, 0, 0}, {1, 0, 0}, 1)), std::invalid_argument);
    EXPECT_THROW(static_cast<void>(castRay(map, {0, 0, 0}, {0, 0, 0}, 1)), std::invalid_argument);
    EXPECT_THROW(static_cast<void>(castRay(map, {0, 0, 0}, {1e200, 0, 0}, 1)),
                 std::invalid_argument);
    EXPECT_THROW(static_cast<void>(castRay(map, {0, 0, 0}, {1, 0, 0}, -1)), std::invalid_argument);
    EXPECT_THROW(static_cast<void>(castRay(map, {0, 0, 0}, {1, 0, 0}, 1, 1)),
                 std::invalid_argument);
}

TEST(SweepSphere, FitsOrCollidesByItsRadius) {
    const AkiMap map = wall();
    const std::vector<TPoint3D> path = {{0.5, 0, 0}, {1.5, 0, 0}, {1.5, 0.3, 0}};
    const SweptPath thin = sweepSphere(map, path, 0.1);
    EXPECT_FALSE(thin.collision);
    EXPECT_GT(thin.least_sure.confidence, 0.5);
    const SweptPath thick = sweepSphere(map, path, 0.7);
    ASSERT_TRUE(thick.collision);
    EXPECT_NEAR(thick.collision->x, kWall, 0.11);
    EXPECT_EQ(sweepSphere(map, {{-5, 0, 0}}, 0.1).least_sure.confidence, 0.5);
    EXPECT_TRUE(sweepSphere(map, {{kWall, 0, 0}}, 0).collision);
}

/** However long the pieces are, what lies between their ends is looked at. */
TEST(SweepSphere, SeesAThinThingOnALongWay) {
    const AkiMap map = wall();
    EXPECT_TRUE(sweepSphere(map, {{0.5, 0, 0}, {30, 0, 0}}, 0.05).collision);
    EXPECT_FALSE(sweepSphere(map, {{0.5, 5, 0}, {30, 5, 0}}, 0.05).collision);
    EXPECT_THROW(static_cast<void>(sweepSphere(map, {}, 0.05)), std::invalid_argument);
    EXPECT_THROW(static_cast<void>(sweepSphere(map, {{0, 0, 0}}, -1)), std::invalid_argument);
}

TEST(SurfaceNormal, OfAWallLooksAtTheSensor) {
    const AkiMap map = wall();
    const auto normal = surfaceNormal(map, kWall, 0.1, 0.1);
    ASSERT_TRUE(normal);
    EXPECT_LT(normal->direction.x, -0.98);
    EXPECT_NEAR(normal->direction.norm(), 1, 1e-9);
    EXPECT_GT(normal->confidence, 0.4);
    EXPECT_LE(normal->confidence, 1);
    EXPECT_FALSE(surfaceNormal(map, 1, 0, 0));
    EXPECT_FALSE(surfaceNormal(map, 50, 50, 50));
}

TEST(SurfaceNormal, IsLessSureWhereTwoWallsMeet) {
    AkiMap map(0.05);
    std::vector<Ray> scan;
    for (int i = -40; i <= 40; i++)
        for (int j = -40; j <= 40; j++) {
            scan.push_back({{0.025, 0.025, 0.025}, {kWall, 0.025 + 0.05 * i, 0.025 * j}});
            scan.push_back({{0.025, 0.025, 0.025}, {0.025 + 0.05 * i, kWall, 0.025 * j}});
        }
    map.insertRays(scan);
    const auto wall = surfaceNormal(map, kWall, 0.5, 0.1),
               edge = surfaceNormal(map, kWall, kWall, 0.1);
    ASSERT_TRUE(wall && edge);
    EXPECT_GT(wall->confidence, edge->confidence + 0.2) << edge->confidence;
}

}  // namespace
