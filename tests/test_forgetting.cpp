// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
// max_evidence: how sure a map gets of what it sees again and again, and how fast it unlearns.
#include <akimap/AkiMap.h>
#include <gtest/gtest.h>

#include <cmath>

#include "grid/BlockGrid.h"
#include "random_scans.h"
#include "run_program.h"
#include "same_map.h"

using namespace akimap;

namespace {

/** A piece of a wall so far ahead of a sensor at the origin. */
std::vector<Ray> wallAt(double x) {
    std::vector<Ray> rays;
    for (double y = -0.2; y <= 0.2; y += 0.05)
        for (double z = -0.2; z <= 0.2; z += 0.05)
            rays.push_back({{0, 0, 0}, {x, y * x / 2, z * x / 2}});
    return rays;
}

AkiMap mapWith(double max_evidence) {
    AkiMap map(0.05);
    map.insertionOptions.max_evidence = max_evidence;
    return map;
}

/** After 2000 scans of a wall it is taken away: the number of scans, up to 1000, until the map says
 * that its place is free. */
int scansToUnlearn(double max_evidence) {
    AkiMap map = mapWith(max_evidence);
    const auto wall = wallAt(2.02), behind = wallAt(3.02);
    for (int i = 0; i < 2000; i++) map.insertRays(wall);
    EXPECT_GT(map.occupancy(2.02, 0.01, 0.01).value(), 0.99);
    for (int i = 0; i < 1000; i++) {
        if (map.occupancy(2.02, 0.01, 0.01).value() < 0.5) return i;
        map.insertRays(behind);
    }
    return 1000;
}

}  // namespace

/** Each scan adds at most 3 to beta, and alpha shrinks by max_evidence / (max_evidence + that):
 * half of it is gone after ln 2 / ln(1 + 3 / max_evidence) scans, 23 for 100. */
TEST(MaxEvidence, AWallThatStoodFor2000ScansIsGoneAfter24) {
    const int scans = scansToUnlearn(InsertionParameters().max_evidence);
    const double fastest = std::log(2) / std::log(1 + 3 / 100.0);
    EXPECT_GE(scans, fastest - 1);
    EXPECT_LE(scans, 1.2 * fastest);
    EXPECT_EQ(scansToUnlearn(0), 1000) << "without a bound it takes 2 / 3 x 2000 scans";
}

TEST(MaxEvidence, NoCellHasMoreAndOccupanciesAreNotChangedByIt) {
    AkiMap bounded = mapWith(0), free = bounded;
    for (unsigned i = 0; i < 20; i++)
        for (AkiMap* map : {&bounded, &free}) {
            map->insertionOptions.max_evidence = map == &bounded && i == 19 ? 30 : 0;
            map->insertRays(test::randomScan(1 + i % 3, 500));
        }
    int scaled = 0;
    free.grid().forEachCell([&](const CellIndex& c, float a, float b) {
        const auto at = [&](int32_t i) { return free.grid().center(i); };
        const CellState s = bounded.cell(at(c.x), at(c.y), at(c.z)).value();
        const double alpha = s.alpha - 1e-3, beta = s.beta - 1e-3,
                     more = static_cast<double>(a + b);
        const double sum = more > 30 && alpha + beta < more - 1e-4 ? 30 : more;  // if it gained
        ASSERT_NEAR(alpha + beta, sum, 1e-4);
        ASSERT_NEAR(alpha / (alpha + beta), static_cast<double>(a) / more, 1e-5);
        scaled += sum < more;
    });
    EXPECT_GT(scaled, 100);
}

TEST(MaxEvidence, BelowItNothingChanges) {
    AkiMap bounded = mapWith(100), free = mapWith(0);
    for (unsigned seed = 1; seed <= 12; seed++)
        bounded.insertRays(test::randomScan(seed, 500)),
            free.insertRays(test::randomScan(seed, 500));
    EXPECT_EQ(test::cellsFingerprint(bounded), test::cellsFingerprint(free));
}

/** Numbers that shrink for hours would become denormal, on which processors are slow. */
TEST(MaxEvidence, WhatIsLongForgottenStaysANormalNumber) {
    AkiMap map = mapWith(1);
    map.insertRays(wallAt(2.02));
    for (int i = 0; i < 300; i++) map.insertRays(wallAt(3.02));
    map.grid().forEachCell([](const CellIndex&, float a, float b) {
        ASSERT_TRUE(a == 0 || std::isnormal(a)) << a;
        ASSERT_TRUE(b == 0 || std::isnormal(b)) << b;
    });
    EXPECT_LT(map.occupancy(2.02, 0.01, 0.01).value(), 0.01);
}

TEST(MaxEvidence, AnIniMaySwitchItOffButNotBelow1) {
    const TemporaryFolder folder;
    writeText(folder.file("s.pcd"),
              "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 1\nHEIGHT 1\n"
              "VIEWPOINT 0 0 0 1 0 0 0\nDATA ascii\n1 0 0\n");
    const auto build = [&](const std::string& value) {
        writeText(folder.file("c.ini"),
                  "[MappingApplication]\nakimap_count = 1\n"
                  "[MappingApplication_akimap_00_insertOpts]\nmax_evidence = " +
                      value + "\n");
        return runProgram("build " + folder.file("s.pcd") + " -c " + folder.file("c.ini") + " -o " +
                          folder.file("m.akimap"));
    };
    ASSERT_EQ(build("0").exit, 0);
    EXPECT_EQ(AkiMap::loadFromFile(folder.file("m.akimap"))->insertionOptions.max_evidence, 0);
    for (const char* bad : {"0.5", "-1", "nan"}) {
        const auto run = build(bad);
        EXPECT_NE(run.exit, 0) << bad;
        EXPECT_NE(run.err.find("max_evidence"), std::string::npos) << run.err;
    }
}
