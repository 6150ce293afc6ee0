// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
//
// Figures of accuracy, the reading of truth files, and `akimap eval`.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>
#include <sstream>
#include <tuple>

#include "evaluation/report.h"
#include "output/export_map.h"
#include "random_scans.h"
#include "run_program.h"

namespace {

using namespace akimap::app;
using akimap::AkiMap;

/** Each occupied cell against each free one. */
double bruteForceAuc(const std::vector<ScoredCell>& cells) {
    double won = 0, pairs = 0;
    for (const ScoredCell& a : cells)
        for (const ScoredCell& b : cells)
            if (a.occupied && !b.occupied) {
                pairs++;
                won += a.occupancy > b.occupancy ? 1 : a.occupancy == b.occupancy ? 0.5 : 0;
            }
    return won / pairs;
}

TEST(Metrics, HandComputed) {
    const Scores s = score({{0.9, true}, {0.8, false}, {0.7, true}, {0.1, false}, {0.3, true}});
    EXPECT_EQ(s.cells, 5u);
    EXPECT_NEAR(s.auc, 4.0 / 6, 1e-12);  // .9 beats both, .7 and .3 the lower one
    EXPECT_NEAR(s.mse, (0.01 + 0.64 + 0.09 + 0.01 + 0.49) / 5, 1e-12);
    EXPECT_NEAR(s.occupied.precision, 2.0 / 3, 1e-12);
    EXPECT_NEAR(s.occupied.recall, 2.0 / 3, 1e-12);
    EXPECT_NEAR(s.occupied.f1, 2.0 / 3, 1e-12);
    EXPECT_NEAR(s.free.precision, 1.0 / 2, 1e-12);
    EXPECT_NEAR(s.free.recall, 1.0 / 2, 1e-12);
    EXPECT_NEAR(s.free.f1, 1.0 / 2, 1e-12);
}

TEST(Metrics, AucIsThatOfAllPairsWithTies) {
    std::mt19937 random(3);
    for (const int levels : {2, 7, 1000000}) {
        std::vector<ScoredCell> cells;
        for (int i = 0; i < 600; i++) {
            const bool occupied = random() % 4 == 0;
            const double p = static_cast<double>(random() % static_cast<unsigned>(levels)) / levels;
            cells.push_back({occupied ? std::sqrt(p) : p, occupied});
        }
        EXPECT_NEAR(score(cells).auc, bruteForceAuc(cells), 1e-12) << levels << " levels";
    }
}

TEST(Metrics, ConstantPerfectAndInvertedMaps) {
    std::vector<ScoredCell> constant, perfect, inverted;
    for (int i = 0; i < 10; i++) {
        const bool occupied = i < 3;
        constant.push_back({0.5, occupied});
        perfect.push_back({occupied ? 1. : 0., occupied});
        inverted.push_back({occupied ? 0. : 1., occupied});
    }
    const Scores c = score(constant), p = score(perfect), i = score(inverted);
    EXPECT_EQ(c.auc, 0.5);
    EXPECT_EQ(c.mse, 0.25);
    EXPECT_TRUE(std::isnan(c.occupied.precision));  // nothing is called occupied
    EXPECT_EQ(c.occupied.recall, 0);
    EXPECT_EQ(c.free.recall, 1);
    EXPECT_EQ(p.auc, 1);
    EXPECT_EQ(p.mse, 0);
    EXPECT_EQ(p.occupied.f1, 1);
    EXPECT_EQ(p.free.f1, 1);
    EXPECT_EQ(i.auc, 0);
    EXPECT_EQ(i.mse, 1);
    EXPECT_EQ(i.occupied.recall, 0);
}

TEST(Metrics, UndefinedIsNullInJsonAndADashInTheTable) {
    const Scores one_class = score({{0.9, true}, {0.4, true}});
    EXPECT_TRUE(std::isnan(one_class.auc));
    const Evaluation evaluation{one_class, one_class, 1};
    EXPECT_TRUE(toJson(evaluation)["known_auc"].is_null());
    EXPECT_TRUE(toJson(evaluation)["all_precision_free"].is_number());
    std::ostringstream table;
    printTable(evaluation, table);
    std::istringstream words(table.str());
    std::string word, known, all;
    while (words >> word && word != "auc") continue;
    words >> known >> all;
    EXPECT_EQ(known, "-");
    EXPECT_EQ(all, "-");
}

/** A tree with single cells on both sides of the origin and blocks that prune to larger leaves. */
octomap::OcTree someTree(double resolution = 0.1) {
    octomap::OcTree tree(resolution);
    const auto set = [&](int x, int y, int z, bool occupied) {
        const auto key = [](int i) { return static_cast<octomap::key_type>(i + 32768); };
        tree.setNodeValue(octomap::OcTreeKey(key(x), key(y), key(z)), occupied ? 3.f : -1.9f);
    };
    for (int x = 0; x < 4; x++)
        for (int y = 0; y < 4; y++)
            for (int z = 0; z < 4; z++) {
                set(x, y, z, true);
                set(x - 8, y, z - 4, false);
            }
    set(-1, -1, -1, true);
    set(-3, 7, 1, false);
    tree.updateInnerOccupancy();
    tree.prune();
    return tree;
}

using Cells = std::map<std::tuple<int, int, int>, bool>;

Cells cellsIn(const Truth& truth, const Box& box = {}) {
    Cells cells;
    truth.forEachCell(box, [&](double x, double y, double z, bool occupied) {
        const auto index = [&](double v) {
            return static_cast<int>(std::floor(v / truth.resolution));
        };
        const bool is_new = cells.insert({{index(x), index(y), index(z)}, occupied}).second;
        EXPECT_TRUE(is_new) << "twice: " << x << " " << y << " " << z;
    });
    return cells;
}

class TruthFile : public ::testing::Test {
 protected:
    void SetUp() override { ASSERT_TRUE(someTree().writeBinary(file)); }
    void expectRefused() const {
        try {
            (void)readTruth(file);
            ADD_FAILURE() << "a damaged file was taken";
        } catch (const std::runtime_error& e) {
            EXPECT_NE(std::string(e.what()).find(file), std::string::npos) << e.what();
        }
    }
    TemporaryFolder folder;
    const std::string file = folder.file("truth.bt");
};

TEST_F(TruthFile, PrunedLeavesAreTakenApart) {
    const octomap::OcTree tree = someTree();
    ASSERT_LT(tree.getNumLeafNodes(), 10u);
    const Truth read = readTruth(file);
    EXPECT_EQ(read.resolution, 0.1);
    const Cells cells = cellsIn(read);
    EXPECT_EQ(cells, cellsIn(truthOf(tree)));
    EXPECT_EQ(cells.size(), 64u + 64 + 2);
    EXPECT_EQ(read.countCells({}), 130);
    for (const auto& [c, occupied] : cells) {
        const auto center = [&](int i) { return (i + 0.5) * 0.1; };
        const auto* node =
            tree.search(center(std::get<0>(c)), center(std::get<1>(c)), center(std::get<2>(c)));
        ASSERT_TRUE(node);
        EXPECT_EQ(tree.isNodeOccupied(node), occupied);
    }
}

TEST_F(TruthFile, ABoxHoldsTheCellsWhoseCentreItHolds) {
    const Truth truth = readTruth(file);
    // On x only the centres 0.15 and 0.25 lie inside, on y all, on z none above 0.15.
    const Cells cells = cellsIn(truth, {{0.06, -1, 0.01}, {0.349, 1, 0.151}});
    EXPECT_EQ(cells.size(), 2u * 4 * 2);
    EXPECT_EQ(truth.countCells({{0.06, -1, 0.01}, {0.349, 1, 0.151}}), 16);
    EXPECT_EQ(cells.begin()->first, std::make_tuple(1, 0, 0));
    EXPECT_EQ(truth.countCells({{5, 5, 5}, {6, 6, 6}}), 0);
}

TEST_F(TruthFile, MissingCutOrForeignIsRefused) {
    const std::string whole = readText(file);
    const auto data = whole.find("data\n") + 5;
    for (const std::size_t length :
         {whole.size() - 1, whole.size() - 4, data, data - 5, std::size_t{0}}) {
        writeText(file, whole.substr(0, length));
        expectRefused();
    }
    writeText(file, "# Octomap OcTree file\n" + whole.substr(whole.find('\n') + 1));
    expectRefused();
    std::filesystem::remove(file);
    expectRefused();
    std::filesystem::create_directory(file);
    expectRefused();
}

TEST_F(TruthFile, EndlessNestingIsRefused) {
    const std::string whole = readText(file);
    writeText(file, whole.substr(0, whole.find("data\n") + 5) + std::string(1 << 20, '\xff'));
    expectRefused();
}

TEST(Box, IsSixAscendingFiniteNumbers) {
    const Box box = parseBox("-1,0,0.5, 2,3e0,4");
    EXPECT_EQ(box.min, (std::array<double, 3>{-1, 0, 0.5}));
    EXPECT_EQ(box.max, (std::array<double, 3>{2, 3, 4}));
    for (const char* wrong :
         {"", "0,0,0,1,1", "0,0,0,1,1,1,1", "0,0,0,1,1,1,", "0,0,0,1,1,x", "0,0,0,1,1,nan",
          "0,0,0,1,1,inf", "0,0,0,1,1,0", "0,2,0,1,1,1", "0,0,0,1,1,1m", "0 0 0 1 1 1"})
        EXPECT_THROW((void)parseBox(wrong), std::runtime_error) << wrong;
}

TEST(Evaluate, WithoutEvidenceIsHalfInAllAndAbsentFromKnown) {
    const Truth truth = truthOf(someTree());
    const auto lookup = [](double x, double, double) -> std::optional<double> {
        if (x < 0) return std::nullopt;  // 66 of the 130 cells
        return x < 0.2 ? 0.9 : 0.2;
    };
    const Evaluation e = evaluate(lookup, 0.1, truth);
    EXPECT_EQ(e.known.cells, 64u);
    EXPECT_EQ(e.all.cells, 130u);
    EXPECT_NEAR(e.coverage, 64.0 / 130, 1e-12);
    EXPECT_NEAR(e.known.mse, (0.01 + 0.64) / 2, 1e-12);
    EXPECT_NEAR(e.all.mse, (32 * 0.01 + 32 * 0.64 + 66 * 0.25) / 130, 1e-12);
    EXPECT_NEAR(e.all.occupied.recall, 32.0 / 65, 1e-12);
}

TEST(Evaluate, OtherResolutionsEmptyBoxesAndEndlessTruthsAreRefused) {
    const auto lookup = [](double, double, double) { return std::optional<double>(0.5); };
    const Truth truth = truthOf(someTree());
    EXPECT_NO_THROW((void)evaluate(lookup, 0.1 * (1 + 1e-7), truth));
    EXPECT_THROW((void)evaluate(lookup, 0.1 * (1 + 1e-5), truth), std::runtime_error);
    EXPECT_THROW((void)evaluate(lookup, 0.1, truth, {{5, 5, 5}, {6, 6, 6}}), std::runtime_error);
    Truth huge;
    huge.resolution = 0.1;
    huge.leaves.push_back({{0, 0, 0}, 32768, false});
    EXPECT_THROW((void)evaluate(lookup, 0.1, huge), std::runtime_error);
    EXPECT_EQ(evaluate(lookup, 0.1, huge, {{0, 0, 0}, {1, 1, 1}}).all.cells, 1000u);
}

TEST(Evaluate, MrptsOctoMapIsScoredByTheSameCode) {
    mrpt::maps::COctoMap map(0.1);
    for (int i = 0; i < 10; i++) {
        map.updateVoxel(0.05, 0.05, 0.05, true);
        map.updateVoxel(-0.75, 0.05, -0.35, false);
    }
    const Evaluation e = evaluate(map, truthOf(someTree()));
    EXPECT_EQ(e.known.cells, 2u);
    EXPECT_EQ(e.known.auc, 1);
    EXPECT_LT(e.known.mse, 0.05);
}

class EvalProgram : public ::testing::Test {
 protected:
    void SetUp() override {
        AkiMap map(0.1);
        map.insertRays(akimap::test::randomScan(1, 600));
        map.saveToFile(file("m.akimap"));
        exportMap(map, file("own.bt"));
    }
    [[nodiscard]] std::string file(const std::string& name) const { return folder.file(name); }
    void expectRefused(const std::string& arguments) const {
        const auto run = runProgram("eval " + arguments);
        EXPECT_NE(run.exit, 0) << arguments;
        EXPECT_LT(run.exit, 128) << arguments;
        EXPECT_EQ(run.out, "") << arguments;
        EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    }
    TemporaryFolder folder;
};

TEST_F(EvalProgram, TheMapsOwnTreeIsItsPerfectTruth) {
    const auto run = runProgram("eval " + file("m.akimap") + " --truth " + file("own.bt") +
                                " --json " + file("e.json"));
    ASSERT_EQ(run.exit, 0) << run.err;
    EXPECT_EQ(run.err, "");
    EXPECT_NE(run.out.find("precision occupied"), std::string::npos);
    const auto json = nlohmann::json::parse(readText(file("e.json")));
    for (const std::string set : {"known_", "all_"}) {
        for (const char* figure : {"auc", "precision_occupied", "recall_occupied", "f1_occupied",
                                   "precision_free", "recall_free", "f1_free"})
            EXPECT_EQ(json.at(set + figure), 1) << set + figure;
        EXPECT_LT(json.at(set + "mse"), 0.1);
        EXPECT_EQ(json.at(set + "cells"), AkiMap::loadFromFile(file("m.akimap"))->cellCount());
    }
    EXPECT_EQ(json.at("coverage"), 1);
}

TEST_F(EvalProgram, TheBoxNarrowsIt) {
    const auto cells = [&](const std::string& more) {
        const auto run = runProgram("eval " + file("m.akimap") + " --truth " + file("own.bt") +
                                    " --json " + file("e.json") + more);
        EXPECT_EQ(run.exit, 0) << run.err;
        return nlohmann::json::parse(readText(file("e.json"))).at("all_cells").get<int>();
    };
    const int west = cells(" --box -9,-9,-9,1.5,9,9"), east = cells(" --box 1.5,-9,-9,9,9,9");
    EXPECT_GT(west, 0);
    EXPECT_GT(east, 0);
    EXPECT_EQ(west + east, cells(""));
}

TEST_F(EvalProgram, BadInputIsRefusedInOneLine) {
    const std::string map = file("m.akimap"), truth = " --truth " + file("own.bt");
    ASSERT_TRUE(someTree(0.05).writeBinary(file("fine.bt")));
    writeText(file("cut.bt"), readText(file("own.bt")).substr(0, 300));
    writeText(file("cut.akimap"), readText(map).substr(0, 300));
    expectRefused(map);
    expectRefused(map + " --truth " + file("none.bt"));
    expectRefused(map + " --truth " + file("cut.bt"));
    expectRefused(map + " --truth " + map);
    expectRefused(map + " --truth " + file("fine.bt"));
    expectRefused(file("none.akimap") + truth);
    expectRefused(file("cut.akimap") + truth);
    expectRefused(map + truth + " --box 0,0,0,1,1");
    expectRefused(map + truth + " --box 0,0,0,1,1,nan");
    expectRefused(map + truth + " --box 50,50,50,60,60,60");
    expectRefused(map + truth + " --json " + file("none/e.json"));
    expectRefused(map + truth + " --boks 0,0,0,1,1,1");
}

TEST_F(EvalProgram, AnOlderPictureSurvivesARefusalAndJsonTellsOfIt) {
    writeText(file("e.json"), "older"), writeText(file("roc.png"), "older");
    expectRefused(file("m.akimap") + " --truth " + file("none.bt") + " --json " + file("e.json") +
                  " --roc " + file("roc.png"));
    EXPECT_EQ(readText(file("roc.png")), "older");
    EXPECT_NE(readText(file("e.json")).find("\"error\": \"cannot read the truth"),
              std::string::npos);
}

}  // namespace
