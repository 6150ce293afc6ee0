// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "estimators/paper/free_samples.h"
#include "grid/BlockGrid.h"
#include "random_scans.h"

using namespace akimap;

namespace {

struct Sampled {
    Samples samples;
    InsertionStats stats;
    BlockGrid grid{0.05};

    explicit Sampled(const std::vector<Ray>& rays, const InsertionParameters& p = {},
                     uint64_t scan = 0) {
        KeyTable taken;
        takeSamples(rays, p, grid, scan, taken, samples, stats);
    }
    [[nodiscard]] std::array<double, 3> at(std::size_t i) const {
        const CellIndex& a = samples.anchor;
        return {a.x * 0.05 + samples.x[i], a.y * 0.05 + samples.y[i], a.z * 0.05 + samples.z[i]};
    }
    [[nodiscard]] std::size_t free() const { return samples.size() - samples.occupied; }
};

const Ray kAlongX{{0.01, 0.02, 0.03}, {4.01, 0.02, 0.03}};  // 4 m

}  // namespace

TEST(Sampling, OneFreeSampleInEachStretchAndOneAtTheOrigin) {
    std::set<int> places;
    for (uint64_t scan = 0; scan < 200; scan++) {
        const Sampled s({kAlongX}, {}, scan);
        ASSERT_EQ(s.samples.occupied, 1u);
        EXPECT_NEAR(s.at(0)[0], 4.01, 1e-6);
        EXPECT_NEAR(s.samples.distance[0], 4, 1e-6);
        ASSERT_GE(s.free(), 7u);  // a draw may share a cell with another sample
        ASSERT_LE(s.free(), 9u);
        EXPECT_EQ(s.samples.distance[1], 0);
        std::set<int> stretches;
        for (std::size_t i = 2; i < s.samples.size(); i++) {
            EXPECT_NEAR(s.at(i)[0] - 0.01, s.samples.distance[i], 1e-5);
            EXPECT_NEAR(s.at(i)[1], 0.02, 1e-6);
            EXPECT_TRUE(stretches.insert(static_cast<int>(s.samples.distance[i] / 0.5f)).second);
            places.insert(static_cast<int>(s.samples.distance[i] / 0.05f));
        }
    }
    EXPECT_GT(places.size(), 70u);  // uniform: all of the ray's 80 cells get their turn
}

TEST(Sampling, DrawsAreUniform) {
    // The fourth stretch of a 2.1 m ray, [1.5, 2): far from the samples of both ends.
    constexpr int kScans = 4000, kBins = 10;
    std::array<int, kBins> counts{};
    for (uint64_t scan = 0; scan < kScans; scan++) {
        const Sampled s({Ray{{0, 0, 0}, {2.1, 0, 0}}}, {}, scan);
        for (const float d : s.samples.distance)
            if (d >= 1.5f && d < 2.0f) counts[static_cast<std::size_t>((d - 1.5f) / 0.05f)]++;
    }
    double chi_squared = 0;
    for (const int n : counts) chi_squared += std::pow(n - kScans / kBins, 2) / (kScans / kBins);
    EXPECT_LT(chi_squared, 27.9);  // 9 degrees of freedom: 0.1 % of uniform draws are above
}

TEST(Sampling, TheDrawsBeyondTheHitAreThrownAway) {
    for (uint64_t scan = 0; scan < 100; scan++) {
        const Sampled s({Ray{{0, 0, 0}, {0.6, 0, 0}}}, {}, scan);
        for (std::size_t i = 1; i < s.samples.size(); i++) EXPECT_LT(s.samples.distance[i], 0.6f);
    }
}

TEST(Sampling, AHitWinsOverAMissAndTheFirstOfACellStays) {
    // The second ray passes through the first one's hit cell; the third hits that cell again.
    const Ray first{{0, 0, 0}, {1.02, 0.02, 0.02}}, through{{0, 0, 0}, {2.04, 0.04, 0.04}},
        again{{0, 0, 0}, {1.03, 0.03, 0.03}};
    for (uint64_t scan = 0; scan < 300; scan++) {
        const Sampled s({first, through, again}, {}, scan);
        EXPECT_EQ(s.samples.occupied, 2u);
        EXPECT_NEAR(s.at(0)[0], 1.02, 1e-6);
        std::set<std::array<int, 3>> cells;
        for (std::size_t i = 0; i < s.samples.size(); i++) {
            const auto p = s.at(i);
            const auto c = s.grid.cellAt(p[0] + 1e-7, p[1] + 1e-7, p[2] + 1e-7);
            EXPECT_TRUE(cells.insert({c.x, c.y, c.z}).second) << "two samples in a cell";
        }
    }
}

TEST(Sampling, RangeRuleKeepsEquality) {
    InsertionParameters p;
    p.min_range = 1, p.max_range = 2;
    const auto ray = [](double length) { return Ray{{10, 20, 30}, {10 + length, 20, 30}}; };
    EXPECT_EQ(Sampled({ray(0.999)}, p).stats.dropped_range, 1u);
    EXPECT_EQ(Sampled({ray(1.0)}, p).stats.points, 1u);
    EXPECT_EQ(Sampled({ray(2.0)}, p).stats.points, 1u);
    EXPECT_EQ(Sampled({ray(2.001)}, p).stats.dropped_range, 1u);
    EXPECT_EQ(Sampled({ray(2.001)}, p).samples.size(),
              0u);  // dropped whole: no free samples either
}

TEST(Sampling, RangesAreFromEachRaysOwnOrigin) {
    InsertionParameters p;
    p.max_range = 2;
    const Sampled s(
        {Ray{{0, 0, 0}, {1, 0, 0}}, Ray{{100, 0, 0}, {101, 0, 0}}, Ray{{0, 0, 0}, {100, 0, 0}}}, p);
    EXPECT_EQ(s.stats.points, 2u);
    EXPECT_EQ(s.stats.dropped_range, 1u);
    EXPECT_NEAR(s.at(1)[0], 101, 1e-5);
}

TEST(Sampling, RaysTooFarApartForOneScansKeysAreDropped) {
    const Sampled s({kAlongX, Ray{{100000, 0, 0}, {100001, 0, 0}}});
    EXPECT_EQ(s.stats.points, 1u);
    EXPECT_EQ(s.stats.dropped_grid, 1u);
}

TEST(Sampling, UnusableRaysAreCountedByReason) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN(),
                     inf = std::numeric_limits<double>::infinity();
    const Sampled s({Ray{{0, 0, 0}, {nan, 0, 0}}, Ray{{inf, 0, 0}, {1, 0, 0}},
                     Ray{{0, 0, 0}, {0, -inf, 0}}, Ray{{1, 1, 1}, {1, 1, 1}},
                     Ray{{1e9, 0, 0}, {1e9 + 1, 0, 0}}, kAlongX});
    EXPECT_EQ(s.stats.rays, 6u);
    EXPECT_EQ(s.stats.dropped_nonfinite, 3u);
    EXPECT_EQ(s.stats.dropped_zero, 1u);
    EXPECT_EQ(s.stats.dropped_grid, 1u);
    EXPECT_EQ(s.stats.points, 1u);
    EXPECT_EQ(s.samples.occupied, 1u);
}

TEST(Sampling, SeedAndScanDecideTheDraws) {
    const auto rays = test::randomScan(3, 50);
    InsertionParameters other;
    other.seed = 2;
    const Sampled a(rays, {}, 5), b(rays, {}, 5), next(rays, {}, 6), seeded(rays, other, 5);
    EXPECT_EQ(a.samples.x, b.samples.x);
    EXPECT_NE(a.samples.x, next.samples.x);
    EXPECT_NE(a.samples.x, seeded.samples.x);
}
