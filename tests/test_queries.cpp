// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
//
// `akimap info` and `akimap query`.
#include <akimap/AkiMap.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "mapping/config.h"
#include "random_scans.h"
#include "run_program.h"

namespace {

using namespace akimap::app;
using akimap::AkiMap;

class Queries : public ::testing::Test {
 protected:
    void SetUp() override {
        map.insertionOptions.max_range = 5.5;
        map.insertionOptions.estimator = akimap::Estimator::paper;
        map.insertionOptions.bandwidth = akimap::Bandwidth::covariance;
        map.insertRays(akimap::test::randomScan(1, 600));
        map.saveToFile(file("m.akimap"));
    }
    [[nodiscard]] std::string file(const std::string& name) const { return folder.file(name); }
    void expectRefused(const std::string& arguments) const {
        const auto run = runProgram(arguments);
        EXPECT_NE(run.exit, 0) << arguments;
        EXPECT_LT(run.exit, 128) << arguments;
        EXPECT_EQ(run.out, "") << arguments;
        EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    }
    TemporaryFolder folder;
    AkiMap map{0.1};
};

TEST_F(Queries, AKnownCellIsToldAsTheMapKnowsIt) {
    int asked = 0, seen = 0;
    map.forEachCell([&](const akimap::Cell& cell_at) {
        const mrpt::math::TPoint3D p(cell_at.x, cell_at.y, cell_at.z);
        const akimap::CellState& cell = cell_at.state;
        if (seen++ % 1000) return;
        asked++;
        std::ostringstream point;
        point << " " << p.x << " " << p.y << " " << p.z;
        const auto run = runProgram("query " + file("m.akimap") + point.str());
        EXPECT_EQ(run.exit, 0) << run.err;
        std::istringstream words(run.out);
        std::string name;
        double occupancy = -1, alpha = -1, beta = -1;
        words >> name >> occupancy >> name >> alpha >> name >> beta;
        EXPECT_NEAR(occupancy, cell.occupancy(), 1e-5 * cell.occupancy()) << run.out;
        EXPECT_NEAR(alpha, cell.alpha, 1e-5 * cell.alpha) << run.out;
        EXPECT_NEAR(beta, cell.beta, 1e-5 * cell.beta) << run.out;
    });
    EXPECT_GE(asked, 5);
}

TEST_F(Queries, WhereNothingIsKnownItSaysSo) {
    for (const char* point : {" 50 50 50", " -50 -0.5 1e3", " 1e30 0 0"}) {
        const auto run = runProgram("query " + file("m.akimap") + point);
        EXPECT_EQ(run.exit, 0) << run.err;
        EXPECT_EQ(run.out, "unknown\n");
    }
}

TEST_F(Queries, BadPointsAndMapsAreRefused) {
    const std::string query = "query " + file("m.akimap");
    for (const char* point :
         {"", " 1 2", " 1 2 3 4", " nan 0 0", " 0 inf 0", " 0 0 -inf", " 1 2 x", " 1 2 3m"})
        expectRefused(query + point);
    writeText(file("cut.akimap"), readText(file("m.akimap")).substr(0, 200));
    writeText(file("no.akimap"), "no map at all");
    for (const char* bad : {"none.akimap", "cut.akimap", "no.akimap"}) {
        expectRefused("query " + file(bad) + " 0 0 0");
        expectRefused("info " + file(bad));
    }
}

TEST_F(Queries, InfoTellsContentsBoundsMemoryAndTheOptionsInForce) {
    const auto run = runProgram("info " + file("m.akimap"));
    ASSERT_EQ(run.exit, 0) << run.err;
    EXPECT_NE(run.out.find(std::to_string(map.cellCount()) + "\n"), std::string::npos) << run.out;
    EXPECT_NE(run.out.find(std::to_string(map.occupiedCells().size()) + "\n"), std::string::npos);
    EXPECT_NE(run.out.find("0.1 m"), std::string::npos);
    EXPECT_NE(run.out.find("bounds"), std::string::npos);
    EXPECT_NE(run.out.find("bytes"), std::string::npos);
    const std::set<std::string> surfaces{"surface_range", "free_radius", "max_evidence"};
    for (const OptionText& option : describe(map.insertionOptions)) {
        const bool told = run.out.find("  " + option.key + " ") != std::string::npos;
        EXPECT_EQ(told, surfaces.count(option.key) == 0) << option.key;
    }
    EXPECT_NE(run.out.find("search_range_origin   0.1\n"), std::string::npos) << "for 0: one cell";
    EXPECT_NE(run.out.find("covariance\n"), std::string::npos);
    EXPECT_NE(run.out.find("5.5\n"), std::string::npos);
}

TEST_F(Queries, InfoAsJson) {
    const auto run = runProgram("info --json " + file("m.akimap"));
    ASSERT_EQ(run.exit, 0) << run.err;
    const auto json = nlohmann::json::parse(run.out);
    const std::size_t occupied = map.occupiedCells().size();
    EXPECT_EQ(json.at("cells"), map.cellCount());
    EXPECT_EQ(json.at("cells_occupied"), occupied);
    EXPECT_EQ(json.at("cells_free"), map.cellCount() - occupied);
    EXPECT_EQ(json.at("resolution"), 0.1);
    EXPECT_EQ(json.at("insertion").at("max_range"), 5.5);
    EXPECT_EQ(json.at("insertion").at("bandwidth"), "covariance");
    EXPECT_GT(json.at("map_bytes"), 8 * map.cellCount());
    const auto box = map.boundingBox();
    double inside = 1;
    for (std::size_t i = 0; i < 3; i++) {
        const double low = json.at("bounds_min").at(i), high = json.at("bounds_max").at(i);
        EXPECT_NEAR(low, box.min[static_cast<int>(i)], 1e-5);
        EXPECT_NEAR(high, box.max[static_cast<int>(i)], 1e-5);
        inside *= std::round((high - low) / 0.1);
    }
    EXPECT_EQ(json.at("cells_unknown"), inside - static_cast<double>(map.cellCount()));
}

TEST_F(Queries, AnEmptyMapIsAMapToo) {
    AkiMap(0.2).saveToFile(file("empty.akimap"));
    const auto json = nlohmann::json::parse(runProgram("info --json " + file("empty.akimap")).out);
    EXPECT_EQ(json.at("cells"), 0);
    EXPECT_EQ(json.at("cells_unknown"), 0);
    EXPECT_EQ(runProgram("query " + file("empty.akimap") + " 0 0 0").out, "unknown\n");
}

}  // namespace
