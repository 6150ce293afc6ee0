// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
// beyond_max_range: what beams say that met nothing up to max_range.
#include <akimap/AkiMap.h>
#include <akimap/rays.h>
#include <gtest/gtest.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationVelodyneScan.h>
#include <mrpt/obs/CRawlog.h>

#include <cmath>
#include <cstring>
#include <random>

#include "grid/BlockGrid.h"
#include "random_scans.h"
#include "run_program.h"
#include "same_map.h"

using namespace akimap;
using namespace mrpt::obs;
using mrpt::poses::CPose3D;

namespace {

constexpr double kRange = 3;  // [m]
const std::array<double, 3> kOrigin{1.3, -0.7, 0.4};

AkiMap mapWith(Estimator estimator, BeyondMaxRange beyond, double max_range = kRange) {
    AkiMap map(0.05);
    map.insertionOptions.estimator = estimator, map.insertionOptions.max_range = max_range;
    map.insertionOptions.beyond_max_range = beyond;
    return map;
}

/** Beams in all directions, which end beyond kRange or, without a hit, before it. */
std::vector<Ray> emptyBeams(unsigned seed, int n) {
    std::mt19937 random(seed);
    std::normal_distribution<double> direction;
    std::uniform_real_distribution<double> length(kRange + 0.01, 50);
    std::vector<Ray> beams;
    while (static_cast<int>(beams.size()) < n) {
        const double x = direction(random), y = direction(random), z = direction(random);
        const bool hit = beams.size() % 2 == 0;
        const double reach = (hit ? length(random) : kRange / 2) / std::hypot(x, y, z);
        beams.push_back({kOrigin,
                         {kOrigin[0] + reach * x, kOrigin[1] + reach * y, kOrigin[2] + reach * z},
                         hit});
    }
    return beams;
}

double fromOrigin(const mrpt::math::TPoint3D& p) {
    return std::hypot(p.x - kOrigin[0], p.y - kOrigin[1], p.z - kOrigin[2]);
}

/** The sums of alpha, cell by cell. */
std::vector<std::pair<CellIndex, float>> alphasOf(const AkiMap& map) {
    std::vector<std::pair<CellIndex, float>> alphas;
    map.grid().forEachCell([&](const CellIndex& c, float a, float) {
        if (a > 0) alphas.emplace_back(c, a);
    });
    return alphas;
}

std::vector<Ray> raysWithFree(const CObservation& o) {
    return raysOf(
               o, [](mrpt::Clock::time_point) { return std::optional(CPose3D()); }, false, true)
        .value();
}

/** Beams over half a turn; the middle third has no return, says the sensor, up to 2 m. */
CObservation2DRangeScan flatScan() {
    CObservation2DRangeScan o;
    o.aperture = static_cast<float>(M_PI), o.maxRange = 2;
    o.resizeScan(181);
    for (std::size_t i = 0; i < 181; i++) {
        const bool valid = i < 60 || i > 120;
        o.setScanRange(i, valid ? 1.5f : 0), o.setScanRangeValidity(i, valid);
    }
    return o;
}

const Estimator kEstimators[] = {Estimator::surface, Estimator::paper};

}  // namespace

TEST(BeyondMaxRange, EmptyBeamsCarveFreeSpaceUpToMaxRangeAndNothingElse) {
    for (const Estimator estimator : kEstimators) {
        AkiMap map = mapWith(estimator, BeyondMaxRange::free);
        ASSERT_TRUE(map.insertRays(emptyBeams(1, 300)));
        EXPECT_EQ(map.stats().free_beams, 300u);
        EXPECT_EQ(map.stats().points, 0u);
        EXPECT_TRUE(alphasOf(map).empty());
        // A sample's kernel is as wide as its neighbours are far: up to sqrt 2 of their range.
        const double kernel = estimator == Estimator::paper
                                  ? std::sqrt(2) * map.insertionOptions.search_range_max
                                  : 0;
        double farthest = 0;
        map.forEachCell([&](const akimap::Cell& cell_at) {
            const mrpt::math::TPoint3D p(cell_at.x, cell_at.y, cell_at.z);
            farthest = std::max(farthest, fromOrigin(p));
        });
        EXPECT_LE(farthest, kRange + kernel);
        EXPECT_GT(farthest, kRange - 0.2);
    }
}

TEST(BeyondMaxRange, ABeamIsFreeAllAlongUpToTheNearerOfItsEndAndMaxRange) {
    for (const double length : {2.0, 3.0, 40.0}) {
        AkiMap map = mapWith(Estimator::surface, BeyondMaxRange::free);
        map.insertRays({Ray{{0.01, 0.01, 0.01}, {0.01 + length, 0.01, 0.01}, false}});
        const double end = std::min(length, kRange);
        for (double x = 0.02; x < end - 0.15; x += 0.05)
            EXPECT_LT(map.occupancy(x, 0.01, 0.01).value_or(1), 0.01) << x;
        for (double x = end + 0.02; x < end + 2; x += 0.05)
            EXPECT_FALSE(map.occupancy(x, 0.01, 0.01)) << x;
    }
}

TEST(BeyondMaxRange, IgnoringThemIsAsIfTheyWereNotThere) {
    for (const Estimator estimator : kEstimators) {
        AkiMap without = mapWith(estimator, BeyondMaxRange::ignore, 6), with = without;
        auto rays = test::randomScan(1, 1000);
        without.insertRays(rays);
        for (Ray& r : emptyBeams(2, 200)) {
            if (r.hit) r.end = {90, 0, 0};
            rays.push_back(r);
        }
        with.insertRays(rays);
        EXPECT_EQ(test::fingerprint(with), test::fingerprint(without));
        EXPECT_EQ(with.stats().dropped_range, 200u);
        EXPECT_EQ(with.stats().free_beams, 0u);
    }
}

TEST(BeyondMaxRange, EmptyBeamsAddNoOccupiedEvidenceToAMap) {
    for (const Estimator estimator : kEstimators) {
        AkiMap map = mapWith(estimator, BeyondMaxRange::free);
        for (unsigned seed = 1; seed <= 3; seed++) map.insertRays(test::randomScan(seed, 500));
        const auto before = alphasOf(map);
        map.insertRays(emptyBeams(3, 300));
        const auto after = alphasOf(map);
        ASSERT_EQ(after.size(), before.size());
        EXPECT_TRUE(std::equal(before.begin(), before.end(), after.begin()));
    }
}

/** In the scan that has them, too, the surfaces go first. */
TEST(BeyondMaxRange, AWallStandsAmongEmptyBeamsOfItsOwnScan) {
    std::vector<Ray> rays;
    for (double y = -1; y <= 1; y += 0.04)
        for (double z = -0.5; z <= 0.5; z += 0.04) rays.push_back({{0, 0, 0}, {2.02, y, z}});
    auto mixed = rays;
    for (double y = -1; y <= 1; y += 0.04)  // close over the wall's upper edge
        for (double z = 0.54; z <= 1; z += 0.04) mixed.push_back({{0, 0, 0}, {2.02, y, z}, false});
    for (Ray& r : mixed)
        if (!r.hit)
            for (double& v : r.end) v *= 3;
    AkiMap alone = mapWith(Estimator::surface, BeyondMaxRange::free), map = alone;
    alone.insertRays(rays), map.insertRays(mixed);
    for (double y = -0.8; y <= 0.8; y += 0.05)
        for (double z = -0.45; z <= 0.45; z += 0.05)
            ASSERT_GT(map.occupancy(2.02, y, z).value_or(0), 0.5) << y << " " << z;
    EXPECT_LT(map.occupancy(2.02, 0.01, 0.9).value_or(1), 0.01);
    EXPECT_FALSE(alone.occupancy(2.02, 0.01, 0.9));
}

TEST(BeyondMaxRange, A2DScanCarvesAlongItsInvalidBeamsToItsOwnMaxRange) {
    AkiMap map = mapWith(Estimator::surface, BeyondMaxRange::free);
    AkiMap ignoring = mapWith(Estimator::surface, BeyondMaxRange::ignore);
    ASSERT_TRUE(map.insertObservation(flatScan()));
    ASSERT_TRUE(ignoring.insertObservation(flatScan()));
    EXPECT_EQ(map.stats().free_beams, 61u);
    EXPECT_LT(map.occupancy(1.75, 0.01, 0.01).value_or(1), 0.01);  // straight ahead
    EXPECT_FALSE(ignoring.occupancy(1.75, 0.01, 0.01));
    EXPECT_FALSE(map.occupancy(2.05, 0.01, 0.01)) << "the sensor sees no farther";
    EXPECT_GT(map.occupancy(0.01, 1.5, 0.01).value_or(0), 0.9);
    EXPECT_FALSE(map.occupancy(0.01, 1.8, 0.01)) << "behind a return";
}

TEST(BeyondMaxRange, PixelsOfRange0LieInTheirOwnDirections) {
    for (const bool range_is_depth : {true, false}) {
        CObservation3DRangeScan o;
        o.cameraParams.ncols = 64, o.cameraParams.nrows = 48;
        o.cameraParams.setIntrinsicParamsFromValues(50, 50, 31.5, 23.5);
        o.range_is_depth = range_is_depth, o.rangeUnits = 0.001f, o.maxRange = 4;
        o.hasRangeImage = true;
        o.rangeImage_setSize(48, 64);
        for (int i = 0; i < 48 * 64; i++) o.rangeImage(i / 64, i % 64) = 4000;  // at maxRange
        const auto full = raysWithFree(o);
        for (int i = 0; i < 48 * 64; i += 3) o.rangeImage(i / 64, i % 64) = 0;
        const auto holes = raysWithFree(o);
        ASSERT_EQ(holes.size(), full.size());
        for (std::size_t i = 0; i < full.size(); i++) {
            EXPECT_EQ(holes[i].hit, i % 3 != 0);
            for (std::size_t a = 0; a < 3; a++)
                ASSERT_NEAR(holes[i].end[a], full[i].end[a], 1e-5) << i;
        }
    }
}

TEST(BeyondMaxRange, VelodynePacketsKnowTheDirectionsOfTheirEmptyBeams) {
    mrpt::obs::CRawlog log;
    if (!log.loadFromRawLogFile("/usr/share/mrpt/datasets/test_velodyne_VLP16.rawlog"))
        GTEST_SKIP() << "mrpt-common's datasets are not installed";
    auto scan = dynamic_cast<const CObservationVelodyneScan&>(*log.getAsObservation(0));
    const auto none = [](mrpt::Clock::time_point) { return std::optional(CPose3D()); };
    auto full = raysWithFree(scan);
    std::size_t number = 0, removed = 0;
    for (auto& packet : scan.scan_packets)
        for (auto& block : packet.blocks)
            for (auto& r : block.laser_returns)
                if (number++ % 7 == 0) {
                    uint16_t distance = 0;  // MRPT's own function takes it to be aligned
                    std::memcpy(&distance, &r, sizeof distance);
                    removed += distance != 0;
                    std::memset(static_cast<void*>(&r), 0, sizeof distance);
                }
    const auto holes = raysWithFree(scan);
    ASSERT_EQ(holes.size(), full.size());
    ASSERT_GT(removed, 100u);
    std::size_t lost = 0;
    for (std::size_t i = 0; i < full.size(); i++) {
        if (holes[i].hit == full[i].hit) continue;
        lost++;
        const auto &a = full[i].end, &b = holes[i].end, &o = full[i].origin;
        const mrpt::math::TPoint3D to(a[0] - o[0], a[1] - o[1], a[2] - o[2]),
            empty(b[0] - o[0], b[1] - o[1], b[2] - o[2]);
        EXPECT_NEAR(empty.norm(), std::min(scan.maxRange, 130.0), 1e-3);
        ASSERT_LT((to * (1 / to.norm()) - empty * (1 / empty.norm())).norm(), 1e-3);
    }
    EXPECT_GT(lost, removed / 3);  // MRPT decodes one in two of this file's
    // Without being asked for there are none, and the returns are the same.
    const auto returns = raysOf(scan, none).value();
    EXPECT_EQ(returns.size(), static_cast<std::size_t>(std::count_if(
                                  holes.begin(), holes.end(), [](const Ray& r) { return r.hit; })));
}

TEST(BeyondMaxRange, TheProgramTakesItFromAnIni) {
    const TemporaryFolder folder;
    const std::string map = folder.file("m.akimap"), ini = folder.file("c.ini");
    writeText(folder.file("s.pcd"),
              "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 1\nHEIGHT 1\n"
              "VIEWPOINT 0.01 0.01 0.01 1 0 0 0\nDATA ascii\n10.2 0.01 0.01\n");
    const auto build = [&](const std::string& value) {
        writeText(ini,
                  "[MappingApplication]\nakimap_count = 1\n"
                  "[MappingApplication_akimap_00_insertOpts]\nbeyond_max_range = " +
                      value + "\n");
        return runProgram("build " + folder.file("s.pcd") + " -c " + ini + " -o " + map);
    };
    const auto run = build("free");
    ASSERT_EQ(run.exit, 0) << run.err;
    EXPECT_NE(run.out.find("beams without a hit"), std::string::npos) << run.out;
    EXPECT_EQ(runProgram("query " + map + " 7.5 0.01 0.01").out.find("unknown"), std::string::npos);
    EXPECT_NE(runProgram("query " + map + " 8.1 0.01 0.01").out.find("unknown"), std::string::npos);
    EXPECT_EQ(AkiMap::loadFromFile(map)->insertionOptions.beyond_max_range, BeyondMaxRange::free);

    const auto typo = build("fre");
    EXPECT_NE(typo.exit, 0);
    EXPECT_NE(typo.err.find("beyond_max_range = 'fre': must be ignore | free"), std::string::npos)
        << typo.err;
}

/** A map of one return 1 m away in cells of 0.2 m, with max_range = 7. */
TEST(MapFormat, FilesOfVersion1StillLoad) {
    const auto map = AkiMap::loadFromFile(AKIMAP_SOURCE_DIR "/tests/data/version1.akimap");
    EXPECT_EQ(map->resolution(), 0.2);
    EXPECT_EQ(map->insertionOptions.max_range, 7);
    EXPECT_EQ(map->insertionOptions.beyond_max_range, BeyondMaxRange::ignore);
    EXPECT_EQ(map->insertionOptions.prior_beta, 1e-3);
    EXPECT_EQ(map->likelihoodOptions.sigma_hit, 0.1);
    EXPECT_GT(map->occupancy(1.01, 0.01, 0.01).value_or(0), 0.6);
    EXPECT_EQ(map->cellCount(), 47u);
}
