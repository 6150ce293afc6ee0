// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "input/clouds/TextCloud.h"

#include <algorithm>
#include <fstream>
#include <stdexcept>

#include "input/clouds/PointFields.h"
#include "input/files.h"
#include "input/numbers.h"

namespace akimap::app {

namespace {

using Words = std::vector<std::string_view>;

bool isNumber(std::string_view word) {
    double value = 0;
    return parseNumber(word, value);
}

PointField column(std::size_t i, std::string name) {
    PointField field;
    field.name = std::move(name);
    field.size = 8;
    field.column = i;
    return field;
}

/** The columns that the first line names, or the usual ones. */
std::vector<PointField> columnsOf(const Words& first) {
    std::vector<PointField> fields;
    if (!isNumber(first.front())) {
        for (std::size_t i = 0; i < first.size(); i++) {
            std::string name(first[i]);
            name.erase(std::remove(name.begin(), name.end(), '"'), name.end());
            fields.push_back(column(i, name));
        }
        return fields;
    }
    // Further columns may be colours or normals; 8 and 12 are what lines of poses have.
    const std::size_t width = first.size();
    if (width != 3 && width != 4 && width != 6 && width != 7)
        throw std::runtime_error("expected x y z and found " + std::to_string(width) +
                                 " numbers, and no line above that names them; poses go to "
                                 "--poses");
    for (const char* name : {"x", "y", "z"}) fields.push_back(column(fields.size(), name));
    if (width == 4 || width == 7) fields.push_back(column(3, "intensity"));
    return fields;
}

void addPoint(const Words& words, std::size_t width, CloudFiller& filler) {
    if (words.size() != width)
        throw std::runtime_error("expected " + std::to_string(width) + " numbers and found " +
                                 std::to_string(words.size()));
    filler.add([&](const PointField& field) {
        double value = 0;
        if (!parseNumber(words[field.column], value))
            throw std::runtime_error("'" + std::string(words[field.column]) + "' is not a number");
        return value;
    });
}

/** Four lines of four numbers, the last of them 0 0 0 1. */
bool isMatrix(const Cloud& cloud) {
    return cloud.points.size() == 4 && cloud.intensity.size() == 4 && cloud.intensity[3] == 1 &&
           cloud.points[3] == std::array<double, 3>{0, 0, 0};
}

}  // namespace

Cloud readTextCloud(const std::string& file) {
    requireReadable(file);
    std::ifstream in(file);
    std::string line;
    Words words;
    std::vector<PointField> fields;
    std::optional<CloudFiller> filler;
    std::size_t width = 0;
    for (std::size_t number = 1; std::getline(in, line); number++) {
        std::replace_if(
            line.begin(), line.end(), [](char c) { return c == ',' || c == ';'; }, ' ');
        splitWords(line, words);
        if (words.empty() || words[0][0] == '#' || words[0].substr(0, 2) == "//") continue;
        try {
            if (!filler) {
                fields = columnsOf(words);
                filler.emplace(fields, 0);
                width = words.size();
                if (!isNumber(words.front())) continue;
            }
            addPoint(words, width, *filler);
        } catch (const std::runtime_error& e) {
            throw std::runtime_error(file + ": line " + std::to_string(number) + ": " + e.what());
        }
    }
    if (in.bad()) throw std::runtime_error(file + ": can't be read to its end");
    if (!filler) return {};
    if (isMatrix(filler->cloud()))
        throw std::runtime_error(file + ": a pose of 4 x 4 numbers, not points; see --poses");
    return std::move(filler->cloud());
}

}  // namespace akimap::app
