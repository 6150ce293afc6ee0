// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
// The locality contract of doc/architecture.md: what a cell gains from a scan depends only on the
// scan, on its number, and on the cell's own block before.
#include <gtest/gtest.h>

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

    insert(all, scan(4), 4);
    insert(region, scan(4), 4);
    EXPECT_EQ(test::blockBits(region, isInRegion), test::blockBits(all, isInRegion));
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
    testing::Values(Case{"surface", Estimator::surface, BeyondMaxRange::ignore, 0.05},
                    Case{"surface_free", Estimator::surface, BeyondMaxRange::free, 0.1},
                    Case{"paper", Estimator::paper, BeyondMaxRange::ignore, 0.1},
                    Case{"paper_free", Estimator::paper, BeyondMaxRange::free, 0.1}),
    [](const auto& test) { return std::string(test.param.name); });
