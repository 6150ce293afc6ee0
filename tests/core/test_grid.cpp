// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <random>
#include <unordered_map>

#include "estimators/estimators.h"
#include "grid/grid_sections.h"
#include "random_scans.h"
#include "same_blocks.h"

using namespace akimap;

namespace {
std::unique_ptr<Block> blockWith(int cell, float alpha) {
    auto block = std::make_unique<Block>();
    block->alpha[static_cast<std::size_t>(cell)] = alpha;
    return block;
}
}  // namespace

TEST(BlockGrid, CellsAreHalfOpenAndCentredAsInOctoMap) {
    const BlockGrid grid(0.5);
    EXPECT_EQ(grid.cellAt(0, 0.499, 0.5), (CellIndex{0, 0, 1}));
    EXPECT_EQ(grid.cellAt(-1e-9, -0.5, -0.501), (CellIndex{-1, -1, -2}));
    EXPECT_DOUBLE_EQ(grid.center(0), 0.25);
    EXPECT_DOUBLE_EQ(grid.center(-1), -0.25);
}

TEST(BlockGrid, BlocksAndOffsetsOfNegativeCells) {
    EXPECT_EQ(BlockGrid::blockOf({-1, -8, -9}), (CellIndex{-1, -1, -2}));
    EXPECT_EQ(BlockGrid::offsetOf({-1, -8, -9}), Block::offset(7, 0, 7));
}

TEST(BlockGrid, KeysRoundTripAndSortByZYX) {
    for (const CellIndex c : {CellIndex{0, 0, 0}, {-1, 1, -1}, {-(1 << 20), (1 << 20) - 1, 5}})
        EXPECT_EQ(unpackKey(packKey(c)), c);
    EXPECT_LT(packKey({5, 5, -1}), packKey({-5, -5, 0}));
    EXPECT_LT(packKey({5, -1, 0}), packKey({-5, 0, 0}));
    EXPECT_LT(packKey({-1, 0, 0}), packKey({0, 0, 0}));
}

TEST(BlockGrid, VisitsOnlyCellsWithEvidenceInOrder) {
    BlockGrid grid(0.1);
    grid.adopt({1, 0, 0}, blockWith(Block::offset(2, 3, 4), 7));
    grid.adopt({-1, 0, 0}, blockWith(0, 5));
    std::vector<CellIndex> cells;
    grid.forEachCell([&](const CellIndex& c, float alpha, float beta) {
        cells.push_back(c);
        EXPECT_EQ(alpha, cells.size() == 1 ? 5 : 7);
        EXPECT_EQ(beta, 0);
    });
    ASSERT_EQ(cells.size(), 2u);
    EXPECT_EQ(cells[0], (CellIndex{-8, 0, 0}));
    EXPECT_EQ(cells[1], (CellIndex{10, 3, 4}));
    EXPECT_EQ(grid.countCells(), 2u);
}

TEST(BlockGrid, CopiesShareBlocksUntilOneWrites) {
    BlockGrid a(0.1);
    a.adopt({0, 0, 0}, blockWith(0, 1));
    BlockGrid b = a;
    EXPECT_EQ(a.find({0, 0, 0}), b.find({0, 0, 0}));
    b.own({0, 0, 0})->alpha[0] = 9;
    EXPECT_EQ(a.find({0, 0, 0})->alpha[0], 1);
    a = b;
    EXPECT_EQ(a.find({0, 0, 0})->alpha[0], 9);
    a.clear();
    EXPECT_TRUE(a.isEmpty());
    EXPECT_EQ(a.find({0, 0, 0}), nullptr);
}

TEST(BlockGrid, CoversOnlyWhatKeysCanHold) {
    const BlockGrid grid(0.05);
    const double far = BlockGrid::kMaxCell * 0.05;
    EXPECT_TRUE(grid.covers(far - 1, -far + 1, 0));
    EXPECT_FALSE(grid.covers(far + 1, 0, 0));
    EXPECT_FALSE(grid.covers(0, -1e300, 0));
    EXPECT_FALSE(grid.covers(0, 0, std::numeric_limits<double>::quiet_NaN()));
}

TEST(BlockGrid, RefusesASenselessResolution) {
    for (const double r : {0.0, -0.1, std::numeric_limits<double>::quiet_NaN(),
                           std::numeric_limits<double>::infinity()})
        EXPECT_THROW(BlockGrid{r}, std::invalid_argument);
}

TEST(BlockGrid, SectionsKeepItWhole) {
    for (const Estimator e : {Estimator::surface, Estimator::paper}) {
        BlockGrid grid(0.1), read_back(0.1);
        InsertionParameters p;
        p.estimator = e;
        InsertionStats stats;
        insertScan(*makeEstimator(e), {test::randomScan(1, 300), 0}, p, grid, stats);

        std::string file;
        const WriteBytes write = [&](const void* bytes, std::size_t n) {
            file.append(static_cast<const char*>(bytes), n);
        };
        writeGrid(write, grid);
        writeEnd(write);
        std::size_t at = 0;
        const ReadBytes read = [&](void* bytes, std::size_t n) {
            ASSERT_LE(at + n, file.size());
            std::memcpy(bytes, &file[at], n);
            at += n;
        };
        SectionReader section(read);
        std::vector<BlockGrid::BlockIndex> blocks;
        while (section.next()) {
            if (section.tag() == kBlocksTag) blocks = readBlocks(section);
            if (section.tag() == kCellsTag) readCells(section, blocks, read_back);
            if (section.tag() == kSurfacesTag) readSurfaces(section, blocks, read_back);
        }
        EXPECT_EQ(test::blockBits(read_back), test::blockBits(grid));
    }
}

TEST(KeyTable, AgreesWithTheStandardMap) {
    KeyTable table;
    std::unordered_map<uint64_t, uint32_t> expected;
    std::mt19937_64 random(1);
    for (uint32_t i = 0; i < 20000; i++) {
        const uint64_t key = random() % 8000 * 0x1000001;
        const auto [value, added] = table.insert(key, i);
        const auto [it, expected_added] = expected.emplace(key, i);
        EXPECT_EQ(added, expected_added);
        EXPECT_EQ(value, it->second);
    }
    EXPECT_EQ(table.size(), expected.size());
    for (const auto& [key, value] : expected) EXPECT_EQ(table.find(key), value);
    EXPECT_EQ(table.find(12345), KeyTable::kNone);
    table.clear();
    EXPECT_EQ(table.size(), 0u);
    EXPECT_EQ(table.find(expected.begin()->first), KeyTable::kNone);
}
