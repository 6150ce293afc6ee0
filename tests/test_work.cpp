// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
// Bounded work: operations counted, not timed, on scans made to be awkward.
#include <akimap/AkiMap.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <ctime>

#include "estimators/paper/PaperEstimator.h"
#include "estimators/paper/free_samples.h"
#include "random_scans.h"
#include "sanitized.h"

using namespace akimap;

namespace {

/** Operations of one scan through rooms 2 to 4, a sample each. */
struct Work {
    double tested;   ///< points tested against regions of eight samples
    double touches;  ///< kernels taken to a block
    std::size_t samples;
};

class Insertion {
 public:
    explicit Insertion(double max_range = 8) { p_.max_range = max_range; }
    Work insert(const std::vector<Ray>& rays) {
        InsertionStats stats;
        const uint64_t before = tested();
        takeSamples(rays, p_, grid_, scans_++, s_.taken, s_.samples, stats);
        bandwidths(s_.samples, p_, grid_.resolution(), s_.neighbors, s_.H);
        scatter(s_, grid_);
        const auto n = static_cast<double>(s_.samples.size());
        return {static_cast<double>(tested() - before) / n,
                static_cast<double>(s_.kernels.overlaps.size()) / n, s_.samples.size()};
    }

 private:
    [[nodiscard]] uint64_t tested() const {
        uint64_t sum = 0;
        for (const SelectorWorkspace& t : s_.neighbors.per_thread) sum += t.tested;
        return sum;
    }
    InsertionParameters p_;
    BlockGrid grid_{0.05};
    PaperWorkspace s_;
    uint64_t scans_ = 0;
};

/** n x n rays over a square wall of this half side [m] at this distance [m]. */
std::vector<Ray> wall(double distance, double half, int n) {
    std::vector<Ray> rays;
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++)
            rays.push_back(
                {{0, 0, 0},
                 {distance, half * (2.0 * i / (n - 1) - 1), half * (2.0 * j / (n - 1) - 1)}});
    return rays;
}

std::vector<Ray> movedBy(double dx, double dy, std::vector<Ray> rays) {
    for (Ray& r : rays)
        for (auto* p : {&r.origin, &r.end}) (*p)[0] += dx, (*p)[1] += dy;
    return rays;
}

/** Of this thread [s]. */
double cpuTime() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/** CPU time [s] of three more scans of a place in a copy of the map. */
double secondsOfScansIn(const AkiMap& map) {
    AkiMap copy = map;
    copy.insertRays(test::randomScan(2, 3000));  // takes over the shared blocks, makes room
    const double start = cpuTime();
    for (unsigned seed = 3; seed < 6; seed++) copy.insertRays(test::randomScan(seed, 3000));
    return cpuTime() - start;
}

/** Least CPU time [s] of a ray of the scan in an empty map. */
double secondsOfARay(Estimator estimator, const std::vector<Ray>& rays) {
    double least = INFINITY;
    for (int i = 0; i < 5; i++) {
        AkiMap map(0.05);
        map.insertionOptions.threads = 1, map.insertionOptions.estimator = estimator;
        const double start = cpuTime();
        map.insertRays(rays);
        least = std::min(least, cpuTime() - start);
    }
    return least / static_cast<double>(rays.size());
}

std::vector<Ray> line(int n) {
    std::vector<Ray> rays;
    for (int i = 0; i < n; i++) rays.push_back({{0, 0, 0}, {7.0 * (i + 1) / n, 0.01, 0.01}});
    return rays;
}

}  // namespace

TEST(Work, AnOrdinaryScan) {
    const Work w = Insertion().insert(wall(3, 2, 100));
    EXPECT_LT(w.tested, 100);
    EXPECT_LT(w.touches, 12);
}

TEST(Work, AWallSeenFromTenCentimetres) {
    const Work w = Insertion().insert(wall(0.1, 1, 300));
    EXPECT_LT(w.tested, 100);
    EXPECT_LT(w.touches, 12);
}

TEST(Work, AllPointsInFourCells) {
    const Work w = Insertion().insert(wall(3.01, 0.01, 300));
    EXPECT_LT(w.samples, 40u);  // four hits, and the free samples of their rays
}

TEST(Work, AMillionPointsOnALine) {
    const Work w = Insertion().insert(line(1000000));
    EXPECT_LT(w.samples, 300u);  // cells of the line
    EXPECT_LT(w.tested, 50);
}

TEST(Work, TheSameScanTwiceCostsTheSame) {
    Insertion insertion;
    const auto rays = wall(3, 2, 60);
    const Work first = insertion.insert(rays), second = insertion.insert(rays);
    EXPECT_NEAR(second.tested, first.tested, 0.05 * first.tested);
    EXPECT_NEAR(second.touches, first.touches, 0.05 * first.touches);
}

TEST(Work, AFarPointChangesNothingForTheOthers) {
    auto rays = wall(3, 2, 100);
    const Work without = Insertion(500).insert(rays);
    rays.push_back({{0, 0, 0}, {-400, 200, 50}});
    const Work with = Insertion(500).insert(rays);
    EXPECT_LT(with.tested, 1.5 * without.tested);
}

TEST(Work, AScanCostsTheSameInAMapAHundredTimesAsLarge) {
    if (sanitized()) GTEST_SKIP() << "a sanitizer's times say nothing";
    for (const Estimator estimator : {Estimator::surface, Estimator::paper}) {
        AkiMap small(0.05);
        small.insertionOptions.threads = 1, small.insertionOptions.estimator = estimator;
        small.insertRays(test::randomScan(1, 3000));
        AkiMap large = small;
        for (int i = 1; i < 100; i++)
            large.insertRays(movedBy(10 * (i % 10), 10 * (i / 10), test::randomScan(1, 3000)));
        ASSERT_GT(large.cellCount(), 80 * small.cellCount());
        double in_small = INFINITY, in_large = INFINITY;
        for (int i = 0; i < 7; i++) {
            in_small = std::min(in_small, secondsOfScansIn(small));
            in_large = std::min(in_large, secondsOfScansIn(large));
        }
        EXPECT_LT(in_large / in_small, 1.2);
    }
}

TEST(Work, AwkwardScansTakeNoMoreThanOrdinaryOnesARay) {
    if (sanitized()) GTEST_SKIP() << "a sanitizer's times say nothing";
    for (const Estimator estimator : {Estimator::surface, Estimator::paper}) {
        const double ordinary = secondsOfARay(estimator, wall(3, 2, 300));
        const auto ratio = [&](const std::vector<Ray>& rays) {
            return secondsOfARay(estimator, rays) / ordinary;
        };
        EXPECT_LT(ratio(wall(0.1, 1, 300)), 1);
        EXPECT_LT(ratio(wall(3.01, 0.01, 300)), 1);
        EXPECT_LT(ratio(line(90000)), 1);
        EXPECT_LT(ratio(wall(3, 2, 600)), 1);  // denser than the cells
    }
}
