// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
//
// `akimap eval` with several maps, plots and JSON, as a user runs it; OctoMap's files as maps.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "evaluation/octomap_file.h"
#include "output/export_map.h"
#include "random_scans.h"
#include "run_program.h"

namespace {

using namespace akimap::app;
using akimap::AkiMap;

class Compare : public ::testing::Test {
 protected:
    void SetUp() override {
        AkiMap map(0.1);
        map.insertRays(akimap::test::randomScan(1, 600));
        map.saveToFile(file("m.akimap"));
        for (const char* name : {"truth.bt", "m.bt", "m.ot"}) exportMap(map, file(name));
        AkiMap less(0.1);
        less.insertRays(akimap::test::randomScan(2, 100));
        less.saveToFile(file("less.akimap"));
        AkiMap(0.1).saveToFile(file("empty.akimap"));
    }
    [[nodiscard]] std::string file(const std::string& name) const { return folder.file(name); }
    [[nodiscard]] ::Run eval(const std::string& arguments) const {
        return runCommand("cd " + folder.path().string() + " && '" + AKIMAP_PROGRAM + "' eval " +
                          arguments);
    }
    void expectRefused(const std::string& arguments, const std::string& why) const {
        const auto run = eval(arguments);
        EXPECT_NE(run.exit, 0) << arguments;
        EXPECT_LT(run.exit, 128) << arguments;
        EXPECT_EQ(run.out, "") << arguments;
        EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
        EXPECT_NE(run.err.find(why), std::string::npos) << run.err;
    }
    [[nodiscard]] nlohmann::json json(const std::string& arguments) const {
        const auto run = eval(arguments + " --json e.json");
        EXPECT_EQ(run.exit, 0) << run.err;
        EXPECT_EQ(run.err, "");
        return nlohmann::json::parse(readText(file("e.json")));
    }
    TemporaryFolder folder;
};

/** The words of the table's row of that name. */
std::vector<std::string> row(const std::string& table, const std::string& name) {
    std::istringstream lines(table);
    for (std::string line; std::getline(lines, line);)
        if (line.rfind(name + " ", 0) == 0) {
            std::istringstream words(line.substr(name.size()));
            return {std::istream_iterator<std::string>(words), {}};
        }
    return {};
}

TEST_F(Compare, TheTableShowsBothMapsAndTheirDifference) {
    const auto run = eval("m.akimap --truth truth.bt --compare less.akimap");
    ASSERT_EQ(run.exit, 0) << run.err;
    EXPECT_EQ(run.out.rfind("[1] m.akimap\n[2] less.akimap\n", 0), 0u) << run.out;
    for (const char* name : {"auc", "mse", "log loss", "calibration error", "f1 free"}) {
        const auto words = row(run.out, name);
        ASSERT_EQ(words.size(), 6u) << name << "\n" << run.out;
        for (std::size_t i = 0; i < 2; i++)
            EXPECT_NEAR(std::stod(words[i + 2]) - std::stod(words[i]), std::stod(words[i + 4]),
                        1.01e-4)
                << name;
    }
    const auto cells = row(run.out, "cells");
    ASSERT_EQ(cells.size(), 6u);
    EXPECT_EQ(cells[0], cells[1]);
    EXPECT_EQ(std::stol(cells[2]) - std::stol(cells[0]), std::stol(cells[4]));
    EXPECT_LT(std::stol(cells[4]), 0);
    EXPECT_EQ(cells[5], "0");
    EXPECT_EQ(row(run.out, "coverage").size(), 3u);
}

TEST_F(Compare, JsonHoldsAllFiguresAndCurvesOfAllMaps) {
    const auto all = json("m.akimap --truth truth.bt --compare less.akimap --compare m.ot");
    ASSERT_EQ(all.at("compare").size(), 2u);
    EXPECT_EQ(all.at("map"), "m.akimap");
    EXPECT_EQ(all.at("compare")[0].at("map"), "less.akimap");
    EXPECT_EQ(all.at("compare")[1].at("map"), "m.ot");
    for (const auto& map : {all, all.at("compare")[0], all.at("compare")[1]})
        for (const std::string set : {"known_", "all_"}) {
            for (const char* figure : {"auc", "mse", "log_loss", "calibration_error"})
                EXPECT_TRUE(map.at(set + figure).is_number()) << set << figure;
            const auto& x = map.at(set + "roc").at("false_positive_rate");
            const auto& y = map.at(set + "roc").at("true_positive_rate");
            ASSERT_EQ(x.size(), y.size());
            double area = 0;
            for (std::size_t i = 1; i < x.size(); i++)
                area += (x[i].get<double>() - x[i - 1].get<double>()) *
                        (y[i].get<double>() + y[i - 1].get<double>()) / 2;
            EXPECT_NEAR(area, map.at(set + "auc").get<double>(), 1e-4);
            std::size_t cells = 0;
            for (const auto& n : map.at(set + "reliability").at("cells"))
                cells += n.get<std::size_t>();
            EXPECT_EQ(cells, map.at(set + "cells").get<std::size_t>());
            EXPECT_EQ(map.at(set + "reliability").at("occupied_fraction").size(), 10u);
        }
    // Alone or compared, a map gets the same figures.
    auto alone = json("less.akimap --truth truth.bt");
    EXPECT_EQ(alone, all.at("compare")[0]);
}

TEST_F(Compare, OctoMapsFilesAreMaps) {
    const auto all = json("m.akimap --truth truth.bt --compare m.ot --compare m.bt");
    const auto &map = all, &ot = all.at("compare")[0], &bt = all.at("compare")[1];
    for (const char* figure : {"known_auc", "known_cells", "all_f1_occupied", "coverage"})
        EXPECT_EQ(map.at(figure), ot.at(figure)) << figure;
    for (const char* figure : {"known_mse", "all_log_loss", "known_calibration_error"})
        EXPECT_NEAR(map.at(figure).get<double>(), ot.at(figure).get<double>(), 1e-4) << figure;
    // A .bt's leaves are at OctoMap's clamping probabilities.
    const double occupied = 0.971, free = 0.1192;
    const auto& cells = bt.at("known_reliability").at("cells");
    const double n = bt.at("known_cells"), full = cells[9];
    EXPECT_EQ(cells[1].get<double>() + full, n);
    const double mse = (full * (1 - occupied) * (1 - occupied) + (n - full) * free * free) / n;
    EXPECT_NEAR(bt.at("known_mse").get<double>(), mse, 1e-4);
}

TEST_F(Compare, PlotsAreDrawn) {
    const auto run =
        eval("m.akimap --truth truth.bt --compare less.akimap --roc r.png --calibration c.svg");
    ASSERT_EQ(run.exit, 0) << run.err;
    EXPECT_EQ(run.err, "");
    EXPECT_EQ(readText(file("r.png")).substr(1, 3), "PNG");
    const std::string svg = readText(file("c.svg"));
    for (const char* words : {"m.akimap (ECE 0.", "less.akimap (ECE 0.", "cells"})
        EXPECT_NE(svg.find(words), std::string::npos) << words;

    ASSERT_EQ(eval("m.akimap --truth truth.bt --compare m.ot --roc r.svg").exit, 0);
    for (const char* words : {"m.akimap, known (AUC 1.000)", "m.ot, all (AUC 1.000)"})
        EXPECT_NE(readText(file("r.svg")).find(words), std::string::npos) << words;
}

TEST_F(Compare, MapsOfOneNameAreToldApartByTheirFolders) {
    std::filesystem::create_directory(folder.path() / "b");
    std::filesystem::copy(file("less.akimap"), file("b/m.akimap"));
    const auto run = eval("m.akimap --truth truth.bt --compare b/m.akimap --calibration c.svg");
    ASSERT_EQ(run.exit, 0) << run.err;
    EXPECT_NE(run.out.find("[2] b/m.akimap"), std::string::npos);
    EXPECT_NE(readText(file("c.svg")).find("\nb/m.akimap (ECE"), std::string::npos);
}

TEST_F(Compare, AMapThatKnowsNothingHasOnlyFiguresOverAll) {
    const auto run =
        eval("empty.akimap --truth truth.bt --json e.json --roc r.svg --calibration c.png");
    ASSERT_EQ(run.exit, 0) << run.err;
    EXPECT_EQ(row(run.out, "log loss"), (std::vector<std::string>{"-", "0.6931"}));
    EXPECT_EQ(row(run.out, "auc"), (std::vector<std::string>{"-", "0.5000"}));
    const auto json = nlohmann::json::parse(readText(file("e.json")));
    EXPECT_TRUE(json.at("known_calibration_error").is_null());
    EXPECT_TRUE(json.at("known_reliability").at("mean_occupancy")[0].is_null());
    EXPECT_EQ(json.at("known_roc").at("false_positive_rate").size(), 0u);
    EXPECT_EQ(readText(file("r.svg")).find("known ("), std::string::npos);
}

TEST_F(Compare, BadRequestsAreRefusedBeforeTheWork) {
    const std::string base = "m.akimap --truth truth.bt ";
    writeText(file("r.png"), "older");
    expectRefused(base + "--roc r.png --calibration c.pdf", "c.pdf");
    expectRefused(base + "--roc r.jpg", "r.jpg");
    expectRefused(base + "--roc r.png --calibration none/c.png", "none/c.png");
    expectRefused(base + "--roc r.png --calibration ./r.png", "given twice");
    expectRefused(base + "--json r.png --roc r.png", "given twice");
    expectRefused(base + "--json ./m.akimap", "input");
    expectRefused(base + "--compare less.akimap --json less.akimap", "input");
    expectRefused(base + "--json truth.bt", "input");
    expectRefused(base + "--compare none.akimap --roc r.png", "none.akimap");
    expectRefused(base + "--compare", "--compare");
    expectRefused(base + "--json /dev/full", "/dev/full");
    AkiMap fine(0.05);
    fine.insertRays(akimap::test::randomScan(1, 100));
    fine.saveToFile(file("fine.akimap"));
    expectRefused(base + "--compare fine.akimap --roc r.png", "fine.akimap");
    EXPECT_EQ(readText(file("r.png")), "older");
    EXPECT_FALSE(std::filesystem::exists(file("c.png")));
}

TEST_F(Compare, WithItselfAMapDiffersByNothing) {
    const auto run = eval("m.akimap --truth truth.bt --compare m.akimap");
    for (const char* name : {"auc", "mse", "coverage"})
        EXPECT_EQ(row(run.out, name).back(), "0.0000") << run.out;
}

TEST_F(Compare, NamesThatAreNoUtf8AreWrittenAllTheSame) {
    std::filesystem::copy(file("less.akimap"), file("l\xff.akimap"));
    const auto all = json("m.akimap --truth truth.bt --compare 'l\xff.akimap' --roc r.png");
    EXPECT_EQ(all.at("compare")[0].at("map"), "l\uFFFD.akimap");
}

TEST_F(Compare, DamagedOctoMapsAreRefused) {
    const std::string base = "m.akimap --truth truth.bt --compare ";
    for (const std::string extension : {".bt", ".ot"}) {
        const std::string whole = readText(file("m" + extension));
        const auto data = whole.find("data\n") + 5;
        for (const std::size_t length :
             {whole.size() - 1, data + 3, data, data - 2, std::size_t{0}}) {
            writeText(file("cut" + extension), whole.substr(0, length));
            expectRefused(base + "cut" + extension, "cut" + extension);
        }
        writeText(file("deep" + extension), whole.substr(0, data) + std::string(1 << 22, '\x7f'));
        expectRefused(base + "deep" + extension, "deep" + extension);
        std::string other = whole;
        other.replace(other.find("id OcTree"), 9, "id NoTree");
        writeText(file("other" + extension), other);
        expectRefused(base + "other" + extension, "other" + extension);
        expectRefused(base + "none" + extension, "none" + extension);
    }
}

TEST_F(Compare, ColoursOfManyMapsRunOutButTheTableDoesNot) {
    std::string arguments = "m.akimap --truth truth.bt --roc r.png";
    for (int i = 0; i < 8; i++) arguments += " --compare less.akimap";
    const auto run = eval(arguments);
    ASSERT_EQ(run.exit, 0) << run.err;
    EXPECT_EQ(row(run.out, "auc").size(), 2u * (9 + 8));
}

}  // namespace
