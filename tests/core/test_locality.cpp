// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
// The locality contract of doc/architecture.md: what a cell gains from a scan depends only on the
// scan, on its number, and on the cell's own block before.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <memory>
#include <ostream>

#include "estimators/estimators.h"
#include "grid/BlockGrid.h"
#include "random_scans.h"
#include "same_blocks.h"

using namespace akimap;

namespace {

struct Case {
    const char* name;
    Estimator estimator;
    BeyondMaxRange beyond_max_range;
    double resolution;
};

void PrintTo(const Case& c, std::ostream* out) {
    *out << c.name;
}

class Locality : public testing::TestWithParam<Case> {
 protected:
    void insert(BlockGrid& grid, const std::vector<Ray>& rays, uint64_t number) const {
        InsertionStats stats;
        insertScan(*makeEstimator(p_.estimator), {rays, number}, p_, grid, stats);
    }
    /** Hits and beams without a return. */
    static std::vector<Ray> scan(unsigned seed) {
        std::vector<Ray> rays = test::randomScan(seed, 600);
        for (std::size_t i = 0; i < rays.size(); i += 7) rays[i].hit = false;
        return rays;
    }
    void SetUp() override {
        p_.estimator = GetParam().estimator;
        p_.beyond_max_range = GetParam().beyond_max_range;
    }
    InsertionParameters p_;
};

/** The same room, from which most of what the scans saw is gone: rays pass where it was. */
std::vector<Ray> throughAll(std::vector<Ray> rays) {
    for (Ray& r : rays) r.end = placeAlong(r, 2);
    return rays;
}

/** A third of the blocks, scattered: every one of them has neighbours that are left out. */
bool isInRegion(const BlockGrid::BlockIndex& b) {
    return (b.x + 2 * b.y + 5 * b.z) % 3 == 0;
}

}  // namespace

TEST_P(Locality, BlocksGainTheSameWhateverElseTheGridHolds) {
    BlockGrid all(GetParam().resolution);
    for (unsigned n = 1; n <= 3; n++) insert(all, scan(n), n);

    BlockGrid region(all.resolution());
    for (const auto& [b, block] : all.sortedBlocks())
        if (isInRegion(b)) region.adopt(b, std::make_shared<Block>(*block));
    ASSERT_GT(region.blockCount(), 20u);
    ASSERT_LT(region.blockCount(), all.blockCount() / 2);

    for (const std::vector<Ray>& next : {scan(4), throughAll(scan(4))}) {
        BlockGrid all_then = all, region_then = region;
        insert(all_then, next, 4);
        insert(region_then, next, 4);
        EXPECT_EQ(test::blockBits(region_then, isInRegion), test::blockBits(all_then, isInRegion));
    }
}

TEST_P(Locality, BlocksGainTheSameOnAnyNumberOfThreads) {
    const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, 4);
    std::vector<Ray> rays;  // enough to be shared among threads, each with its own side of the room
    for (unsigned seed = 1; seed <= 8; seed++)
        for (const Ray& r : scan(seed)) rays.push_back(r);
    std::sort(rays.begin(), rays.end(),
              [](const Ray& a, const Ray& b) { return a.end[1] < b.end[1]; });
    BlockGrid one(GetParam().resolution), four(GetParam().resolution);
    p_.threads = 1;
    insert(one, rays, 1);
    p_.threads = 4;
    insert(four, rays, 1);
    EXPECT_EQ(test::blockBits(one), test::blockBits(four));
}

TEST_P(Locality, BlocksGainTheSameFromASecondEstimatorObject) {
    BlockGrid one(GetParam().resolution), other(GetParam().resolution);
    const auto kept = makeEstimator(p_.estimator);
    InsertionStats stats;
    for (unsigned n = 1; n <= 3; n++) {
        const auto rays = scan(n);
        insertScan(*kept, {rays, n}, p_, one, stats);
        insert(other, rays, n);  // by a fresh one each time: workspaces hold no state
    }
    EXPECT_EQ(test::blockBits(one), test::blockBits(other));
}

INSTANTIATE_TEST_SUITE_P(
    Estimators, Locality,
    testing::Values(Case{"surface", Estimator::surface, BeyondMaxRange::ignore, 0.1},
                    Case{"surface_free", Estimator::surface, BeyondMaxRange::free, 0.05},
                    Case{"paper", Estimator::paper, BeyondMaxRange::ignore, 0.1},
                    Case{"paper_free", Estimator::paper, BeyondMaxRange::free, 0.1}),
    [](const auto& test) { return std::string(test.param.name); });
