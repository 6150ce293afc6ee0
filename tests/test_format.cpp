// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
// Map files of every format so far, each beside a list of all that it says: tests/data/README.md.
#include <akimap/AkiMap.h>
#include <gtest/gtest.h>

#include <cinttypes>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>

#include "mrpt/option_fields.h"
#include "same_map.h"

using namespace akimap;

namespace {

constexpr const char* kData = AKIMAP_SOURCE_DIR "/tests/data/";

/** A list as tests/data/list_map.py makes it. */
struct GoldenList {
    std::map<std::string, std::string> values;
    std::multiset<std::string> cells;
};

GoldenList readList(const std::string& file) {
    std::ifstream in(file);
    EXPECT_TRUE(in) << file;
    GoldenList list;
    for (std::string line; std::getline(in, line);) {
        const auto equals = line.find(" = ");
        if (equals == std::string::npos)
            list.cells.insert(line);
        else
            list.values[line.substr(0, equals)] = line.substr(equals + 3);
    }
    return list;
}

/** The cells of a map as such a list has them: the bits of their sums, without the prior. */
std::multiset<std::string> cellsOf(const AkiMap& map) {
    std::multiset<std::string> cells;
    const auto bits = [](float v) {
        uint32_t b = 0;
        std::memcpy(&b, &v, sizeof b);
        return b;
    };
    map.grid().forEachCell([&](const CellIndex& c, float alpha, float beta) {
        char line[80];
        std::snprintf(line, sizeof line, "cell %d %d %d %08" PRIx32 " %08" PRIx32, c.x, c.y, c.z,
                      bits(alpha), bits(beta));
        cells.insert(line);
    });
    return cells;
}

/** Compares each of the options that the list has, and counts them. */
struct OptionCheck {
    const GoldenList& list;
    std::string prefix;
    std::size_t& compared;

    template <class T>
    void operator()(const char* name, const T& value, const char*) const {
        const auto line = list.values.find(prefix + name);
        if (line == list.values.end()) return;
        compared++;
        if constexpr (std::is_same_v<T, double>)
            EXPECT_EQ(value, std::stod(line->second)) << line->first;
        else
            EXPECT_EQ(std::to_string(static_cast<uint64_t>(value)), line->second) << line->first;
    }
};

std::vector<std::string> goldenFiles() {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(kData))
        if (entry.path().extension() == ".akimap") names.push_back(entry.path().stem().string());
    std::sort(names.begin(), names.end());
    return names;
}

class GoldenMap : public testing::TestWithParam<std::string> {};

}  // namespace

TEST_P(GoldenMap, HoldsEachOptionAndCellThatItsListHas) {
    const auto map = AkiMap::loadFromFile(kData + GetParam() + ".akimap");
    const GoldenList list = readList(kData + GetParam() + ".txt");
    const auto& generic = map->genericMapParams;
    const auto number_of_scans = "scan_index = " + list.values.at("scan_index") + "\n";
    EXPECT_NE(test::bytes(*map).find(number_of_scans), std::string::npos) << number_of_scans;
    std::size_t compared = 2;  // the format, and that number
    const auto check = [&](const char* name, const auto& value) {
        OptionCheck{list, "", compared}(name, value, "");
    };
    check("resolution", map->resolution());
    check("enableSaveAs3DObject", generic.enableSaveAs3DObject);
    check("enableObservationLikelihood", generic.enableObservationLikelihood);
    check("enableObservationInsertion", generic.enableObservationInsertion);
    visitFields(map->insertionOptions, OptionCheck{list, "insertion.", compared});
    visitFields(map->likelihoodOptions, OptionCheck{list, "likelihood.", compared});
    visitFields(map->renderingOptions, OptionCheck{list, "rendering.", compared});
    EXPECT_EQ(compared, list.values.size());
    EXPECT_GT(list.cells.size(), 40u);
    EXPECT_EQ(cellsOf(*map), list.cells);
}

INSTANTIATE_TEST_SUITE_P(MapFormat, GoldenMap, testing::ValuesIn(goldenFiles()),
                         [](const auto& golden) { return golden.param; });
