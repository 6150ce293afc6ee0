// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
// Matching and nearest neighbours against brute force over the surface points.
#include <akimap/AkiMap.h>
#include <gtest/gtest.h>
#include <mrpt/maps/CMultiMetricMap.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/poses/CPose2D.h>
#include <mrpt/tfest/TMatchingPair.h>

#include <algorithm>
#include <limits>
#include <random>
#include <set>
#include <thread>

#include "random_scans.h"
#include "run_program.h"

using namespace akimap;
using mrpt::maps::CSimplePointsMap;
using mrpt::maps::TMatchingExtraResults;
using mrpt::maps::TMatchingParams;
using mrpt::math::TPoint3Df;
using mrpt::poses::CPose2D;
using mrpt::poses::CPose3D;
using mrpt::tfest::TMatchingPairList;

namespace {

AkiMap roomMap() {
    AkiMap map(0.1);
    for (unsigned seed = 1; seed <= 3; seed++)
        EXPECT_TRUE(map.insertRays(test::randomScan(seed, 400)));
    return map;
}

CSimplePointsMap cloud(unsigned seed, std::size_t n) {
    CSimplePointsMap points;
    for (const Ray& r : test::randomScan(seed, n))
        points.insertPoint(static_cast<float>(r.end[0]), static_cast<float>(r.end[1]),
                           static_cast<float>(r.end[2]));
    return points;
}

float sqrDistance(const TPoint3Df& a, const TPoint3Df& b, bool from_above) {
    const TPoint3Df d = a - b;
    return d.x * d.x + d.y * d.y + (from_above ? 0 : d.z * d.z);
}

/** Every pair that the parameters allow, found by trying all. */
std::set<std::pair<std::size_t, std::size_t>> bruteForce(const AkiMap& map,
                                                         const CSimplePointsMap& other,
                                                         const CPose3D& pose, bool flat,
                                                         const TMatchingParams& params) {
    const auto surface = map.surfacePoints();
    std::set<std::pair<std::size_t, std::size_t>> pairs;
    for (std::size_t i = params.offset_other_map_points; i < other.size();
         i += params.decimation_other_map_points) {
        TPoint3Df l, p;
        other.getPoint(i, l.x, l.y, l.z);
        pose.composePoint(l.x, l.y, l.z, p.x, p.y, p.z);
        const float reach =
            params.maxDistForCorrespondence +
            params.maxAngularDistForCorrespondence *
                std::sqrt(sqrDistance(p, params.angularDistPivotPoint.cast<float>(), flat));
        const auto nearest =
            std::min_element(surface.begin(), surface.end(), [&](const auto& a, const auto& b) {
                return sqrDistance(a, p, false) < sqrDistance(b, p, false);
            });
        const float up = flat ? (nearest->z - p.z) * (nearest->z - p.z) : 0;
        for (std::size_t j = 0; j < surface.size(); j++) {
            if (params.onlyKeepTheClosest && surface[j] != *nearest) continue;
            const bool in_ball = sqrDistance(surface[j], p, false) < reach * reach + up;
            const bool within = sqrDistance(surface[j], p, flat) < reach * reach;
            if (within && (params.onlyKeepTheClosest || in_ball)) pairs.insert({j, i});
        }
    }
    return pairs;
}

std::vector<TMatchingParams> someParams() {
    TMatchingParams near, angular, all, thinned;
    near.maxDistForCorrespondence = 0.12f;
    angular.maxDistForCorrespondence = 0.02f, angular.maxAngularDistForCorrespondence = 0.05f;
    angular.angularDistPivotPoint = {1, -0.5, 0.7};
    all.onlyKeepTheClosest = false, all.maxDistForCorrespondence = 0.2f;
    thinned.decimation_other_map_points = 7, thinned.offset_other_map_points = 3;
    return {near, angular, all, thinned};
}

struct Matches {
    TMatchingPairList pairs;
    TMatchingExtraResults extra;
};

Matches matches(const AkiMap& map, const CSimplePointsMap& other, bool flat,
                const TMatchingParams& params) {
    Matches m;
    if (flat)
        map.determineMatching2D(&other, CPose2D(0.05, -0.08, 0.1), m.pairs, params, m.extra);
    else
        map.determineMatching3D(&other, CPose3D(0.05, -0.08, 0.03, 0.1, -0.05, 0.04), m.pairs,
                                params, m.extra);
    return m;
}
CPose3D poseOf(bool flat) {
    return flat ? CPose3D(0.05, -0.08, 0, 0.1, 0, 0) : CPose3D(0.05, -0.08, 0.03, 0.1, -0.05, 0.04);
}

}  // namespace

TEST(SurfacePoints, AreNumbersForEveryPrior) {
    // A prior that speaks for occupied makes no surface where nothing was hit.
    for (const double prior_alpha : {1e-3, 0.5, 10.0}) {
        AkiMap map = roomMap();
        map.insertionOptions.prior_alpha = prior_alpha;
        map.insertionOptions.prior_beta = 1e-3;
        const auto points = map.surfacePoints();
        ASSERT_FALSE(points.empty());
        for (const TPoint3Df& p : points)
            ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
        TPoint3Df nearest;
        float distance = -1;
        uint64_t index = 0;
        ASSERT_TRUE(map.nn_single_search(points[3], nearest, distance, index));
        EXPECT_EQ(distance, 0);
    }
}

TEST(Matching, FindsThePairsThatBruteForceFinds) {
    const AkiMap map = roomMap();
    const CSimplePointsMap other = cloud(9, 200);
    for (const bool flat : {false, true})
        for (const auto& params : someParams()) {
            const auto wanted = bruteForce(map, other, poseOf(flat), flat, params);
            ASSERT_GE(wanted.size(), 10u);
            const Matches found = matches(map, other, flat, params);
            std::set<std::pair<std::size_t, std::size_t>> pairs;
            std::set<std::size_t> locals, wanted_locals;
            double sum = 0;
            for (const auto& p : found.pairs) {
                pairs.insert({p.globalIdx, p.localIdx});
                locals.insert(p.localIdx);
                sum += static_cast<double>(p.errorSquareAfterTransformation);
            }
            for (const auto& p : wanted) wanted_locals.insert(p.second);
            // Neighbouring cells may share a point: then either is the nearest.
            EXPECT_TRUE(std::includes(wanted.begin(), wanted.end(), pairs.begin(), pairs.end()));
            EXPECT_EQ(locals, wanted_locals);
            EXPECT_EQ(found.pairs.size(),
                      params.onlyKeepTheClosest ? locals.size() : wanted.size());
            EXPECT_NEAR(found.extra.sumSqrDist, sum / static_cast<double>(pairs.size()), 1e-6);
        }
}

TEST(Matching, RatioCountsThePointsLookedAtThatFoundAPartner) {
    const AkiMap map = roomMap();
    const auto surface = map.surfacePoints();
    CSimplePointsMap other;
    for (std::size_t i = 0; i < 30; i++)
        other.insertPoint(surface[i].x, surface[i].y, surface[i].z);
    for (int i = 0; i < 10; i++) other.insertPoint(50, 50, static_cast<float>(i));
    mrpt::maps::TMatchingRatioParams ratio;
    EXPECT_FLOAT_EQ(map.compute3DMatchingRatio(&other, CPose3D(), ratio), 0.75f);
    TMatchingParams thinned;
    thinned.decimation_other_map_points = 3, thinned.onlyKeepTheClosest = false;
    TMatchingPairList pairs;
    TMatchingExtraResults extra;
    map.determineMatching3D(&other, CPose3D(), pairs, thinned, extra);
    EXPECT_FLOAT_EQ(extra.correspondencesRatio, 10 / 14.f);
}

TEST(Matching, UniqueRobustKeepsTheBestPartnerOfEachSurfacePoint) {
    const AkiMap map = roomMap();
    const CSimplePointsMap other = cloud(9, 400);
    TMatchingParams params;
    const auto all = matches(map, other, false, params).pairs;
    params.onlyUniqueRobust = true;
    const auto unique = matches(map, other, false, params).pairs;
    ASSERT_LT(unique.size(), all.size());
    std::set<std::size_t> seen;
    for (const auto& p : unique) {
        EXPECT_TRUE(seen.insert(p.globalIdx).second);
        for (const auto& q : all)
            if (q.globalIdx == p.globalIdx) {
                EXPECT_LE(p.errorSquareAfterTransformation, q.errorSquareAfterTransformation);
            }
    }
}

TEST(Matching, SurfacePointsLieNearerToTheSurfaceThanCentres) {
    double points = 0, centres = 0;
    for (double wall = 2.0025; wall < 2.05; wall += 0.005) {  // through cells of 5 cm at all depths
        AkiMap map(0.05);
        std::mt19937 random(3);
        std::uniform_real_distribution<double> unit(-0.5, 0.5);
        std::normal_distribution<double> noise(0, 0.01);
        std::vector<Ray> rays;
        for (int i = 0; i < 4000; i++)
            rays.push_back({{0, 0, 0}, {wall + noise(random), unit(random), unit(random)}});
        map.insertRays(rays);
        const auto surface = map.surfacePoints();
        const auto cells = map.occupiedCells();
        ASSERT_LE(surface.size(), cells.size());  // those that the surface passes through
        ASSERT_GT(surface.size(), 400u);
        const auto sumOfErrors = [&](const auto& list) {
            double sum = 0;
            for (const auto& p : list) sum += std::abs(static_cast<double>(p.x) - wall);
            return sum / static_cast<double>(list.size());
        };
        points += sumOfErrors(surface), centres += sumOfErrors(cells);
    }
    RecordProperty("points_mm", std::to_string(points * 100));
    EXPECT_LT(points, 0.6 * centres);
    EXPECT_LT(points / 10, 0.006);
}

TEST(Matching, IsNeverStale) {
    AkiMap map = roomMap();
    const auto nearestX = [](const AkiMap& m) {
        TPoint3Df p;
        float d = 0;
        uint64_t i = 0;
        return m.nn_single_search(TPoint3Df(9, 9, 9), p, d, i) ? p.x : -1;
    };
    EXPECT_LT(nearestX(map), 3.2f);
    const AkiMap before = map;
    map.insertRays({Ray{{7, 9, 9}, {9, 9, 9}}});
    EXPECT_NEAR(nearestX(map), 9, 0.1);
    EXPECT_LT(nearestX(before), 3.2f);
    map.auxParticleFilterCleanUp();
    EXPECT_NEAR(nearestX(map), 9, 0.1);
    map.clear();
    EXPECT_EQ(nearestX(map), -1);
    map.insertRays({Ray{{7, 9, 9}, {8, 9, 9}}});
    EXPECT_NEAR(nearestX(map), 8, 0.1);
    AkiMap other(0.1);  // as many scans, blocks and cells, elsewhere
    other.insertRays({Ray{{5, 9, 9}, {6, 9, 9}}});
    EXPECT_NEAR(nearestX(other), 6, 0.1);
    map = other;
    EXPECT_NEAR(nearestX(map), 6, 0.1);
    map.insertionOptions.prior_beta = 1e6;  // nothing is occupied any more
    EXPECT_EQ(nearestX(map), -1);
}

TEST(Matching, IsNeverStaleAfterLoading) {
    const TemporaryFolder folder;
    AkiMap a(0.1), b(0.1);
    a.insertRays({Ray{{0, 0, 1}, {2, 0, 1}}});
    b.insertRays({Ray{{0, 0, 1}, {4, 0, 1}}});
    EXPECT_NEAR(a.squareDistanceToClosestCorrespondence(4, 0), 4, 0.3);
    b.saveToFile((folder.path() / "b.akimap").string());
    a = *AkiMap::loadFromFile((folder.path() / "b.akimap").string());
    EXPECT_NEAR(a.squareDistanceToClosestCorrespondence(4, 0), 0, 0.01);
}

TEST(Matching, ManyThreadsAtOnceAgree) {
    const AkiMap map = roomMap();
    const CSimplePointsMap other = cloud(9, 300);
    std::vector<Matches> found(8);
    std::vector<float> above(8);
    std::vector<std::thread> threads;
    for (std::size_t t = 0; t < found.size(); t++)
        threads.emplace_back([&, t] {
            found[t] = matches(map, other, t % 2 == 0, {});
            above[t] = map.squareDistanceToClosestCorrespondence(7, 7);
        });
    for (auto& t : threads) t.join();
    const AkiMap alone = map;
    for (std::size_t t = 0; t < found.size(); t++) {
        const auto expected = matches(alone, other, t % 2 == 0, {});
        EXPECT_EQ(found[t].pairs.size(), expected.pairs.size());
        EXPECT_EQ(found[t].extra.sumSqrDist, expected.extra.sumSqrDist);
        EXPECT_EQ(above[t], above[0]);
    }
}

TEST(Matching, NearestNeighborsAreThoseOfBruteForce) {
    const AkiMap map = roomMap();
    const auto surface = map.surfacePoints();
    ASSERT_EQ(map.nn_index_count(), surface.size());
    std::mt19937 random(5);
    std::uniform_real_distribution<float> unit(-1, 4);
    for (int i = 0; i < 200; i++) {
        const TPoint3Df q(unit(random), unit(random), unit(random));
        std::vector<float> sorted;
        for (const auto& s : surface) sorted.push_back(sqrDistance(s, q, false));
        std::sort(sorted.begin(), sorted.end());
        std::vector<TPoint3Df> points;
        std::vector<float> d;
        std::vector<uint64_t> index;
        map.nn_multiple_search(q, 5, points, d, index);
        ASSERT_EQ(d.size(), 5u);
        for (std::size_t k = 0; k < 5; k++) {
            EXPECT_NEAR(d[k], sorted[k], 1e-5);
            EXPECT_EQ(points[k], surface[index[k]]);
        }
        map.nn_radius_search(q, 0.5f, points, d, index);
        const auto within = std::lower_bound(sorted.begin(), sorted.end(), 0.5f) - sorted.begin();
        EXPECT_NEAR(static_cast<double>(d.size()), static_cast<double>(within), 1);
        map.nn_radius_search(q, 100.f, points, d, index, 2);
        EXPECT_EQ(d.size(), 2u);
    }
}

TEST(Matching, NoVirtualThrowsOnEmptyOrFullMaps) {
    const AkiMap full = roomMap(), empty(0.1);
    const CSimplePointsMap points = cloud(9, 50), no_points;
    mrpt::maps::CMultiMetricMap several;
    several.maps.push_back(mrpt::maps::CSimplePointsMap::Create(points));
    const mrpt::maps::COccupancyGridMap2D grid;
    for (const AkiMap* map : {&full, &empty}) {
        for (const mrpt::maps::CMetricMap* other :
             std::vector<const mrpt::maps::CMetricMap*>{&points, &no_points, &full, &empty}) {
            TMatchingPairList pairs;
            TMatchingExtraResults extra;
            map->determineMatching2D(other, CPose2D(), pairs, {}, extra);
            map->determineMatching3D(other, CPose3D(), pairs, {}, extra);
            EXPECT_EQ(pairs.empty(), map == &empty || other == &empty || other == &no_points);
        }
        EXPECT_EQ(map->compute3DMatchingRatio(&several, CPose3D(), {}) > 0.5f, map == &full);
        EXPECT_EQ(map->compute3DMatchingRatio(&grid, CPose3D(), {}), 0);
        EXPECT_EQ(map->getAsSimplePointsMap(), nullptr);
        EXPECT_EQ(map->isEmpty(), map == &empty);
        EXPECT_TRUE(map->getVisualization());
        EXPECT_FALSE(map->asString().empty());
    }
    EXPECT_EQ(empty.squareDistanceToClosestCorrespondence(0, 0), std::numeric_limits<float>::max());
    EXPECT_EQ(full.squareDistanceToClosestCorrespondence(NAN, 0),
              std::numeric_limits<float>::max());
}

TEST(Matching, RefusesWhatItCanNotUseNamingIt) {
    const AkiMap map = roomMap();
    const mrpt::maps::COccupancyGridMap2D grid;
    const CSimplePointsMap points = cloud(9, 50);
    TMatchingPairList pairs;
    TMatchingExtraResults extra;
    EXPECT_THROW(map.determineMatching2D(&grid, CPose2D(), pairs, {}, extra),
                 std::invalid_argument);
    EXPECT_THROW(map.determineMatching3D(nullptr, CPose3D(), pairs, {}, extra),
                 std::invalid_argument);
    TMatchingParams params;
    params.decimation_other_map_points = 0;
    EXPECT_THROW(map.determineMatching3D(&points, CPose3D(), pairs, params, extra),
                 std::invalid_argument);
}
