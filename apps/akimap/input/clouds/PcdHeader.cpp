// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "input/clouds/PcdHeader.h"

#include <cmath>
#include <map>
#include <stdexcept>
#include <string_view>

#include "input/numbers.h"

namespace akimap::app {

namespace {

using Words = std::vector<std::string>;

/** One line of the header: its place and the words behind its keyword. */
struct Entry {
    std::size_t line = 0;
    Words words;

    [[noreturn]] void refuse(const std::string& what) const {
        throw std::runtime_error("line " + std::to_string(line) + ": " + what);
    }
    [[nodiscard]] std::size_t number(std::size_t i, std::size_t max) const {
        std::size_t value = 0;
        if (i >= words.size()) refuse("a number is missing");
        if (!parseNumber(std::string_view(words[i]), value) || value > max)
            refuse("'" + words[i] + "' is not a whole number from 0 to " + std::to_string(max));
        return value;
    }
};
using Entries = std::map<std::string, Entry, std::less<>>;

constexpr std::size_t kMaxPoints = std::size_t{1} << 40;
constexpr std::size_t kMaxPointSize = std::size_t{1} << 20;  // [bytes]; their product fits

Entries readEntries(std::istream& in, std::size_t& line_number) {
    constexpr std::string_view keywords =
        " VERSION FIELDS COLUMNS SIZE TYPE COUNT WIDTH HEIGHT VIEWPOINT POINTS DATA ";
    Entries entries;
    std::string line;
    std::vector<std::string_view> words;
    while (!entries.count("DATA")) {
        ++line_number;
        if (!std::getline(in, line) || line.size() > 100000)
            throw std::runtime_error("line " + std::to_string(line_number) +
                                     ": no DATA line; this is not a whole PCD header");
        splitWords(line, words);
        if (words.empty() || words.front().front() == '#') continue;
        std::string key(words.front());
        Entry entry{line_number, Words(words.begin() + 1, words.end())};
        if (keywords.find(" " + key + " ") == std::string_view::npos)
            entry.refuse("this is not a PCD file, whose header has no '" + key.substr(0, 20) + "'");
        if (key == "COLUMNS") key = "FIELDS";
        if (!entries.emplace(key, entry).second) entry.refuse("a second " + key);
    }
    return entries;
}

const Entry* find(const Entries& entries, const std::string& key) {
    const auto found = entries.find(key);
    return found == entries.end() ? nullptr : &found->second;
}

const Entry& require(const Entries& entries, const char* key) {
    if (const Entry* entry = find(entries, key)) return *entry;
    entries.at("DATA").refuse("the header above has no " + std::string(key));
}

void readFields(const Entries& entries, PcdHeader& header) {
    const Entry& names = require(entries, "FIELDS");
    const Entry& sizes = require(entries, "SIZE");
    const Entry& types = require(entries, "TYPE");
    const Entry* counts = find(entries, "COUNT");
    const std::size_t n = names.words.size();
    for (const Entry* entry : {&sizes, &types, counts})
        if (entry && entry->words.size() != n)
            entry->refuse("expected " + std::to_string(n) + " words, one for each field");
    for (std::size_t i = 0; i < n; i++) {
        PointField field;
        field.name = names.words[i];
        field.size = sizes.number(i, 8);
        if (field.size == 0 || (field.size & (field.size - 1)) != 0)
            sizes.refuse("'" + sizes.words[i] + "' is not 1, 2, 4 or 8");
        if (types.words[i].size() != 1 ||
            std::string_view("IUF").find(types.words[i]) == std::string_view::npos)
            types.refuse("'" + types.words[i] + "' is not I, U or F");
        field.type = types.words[i].front();
        if (counts) field.count = counts->number(i, 1000000);
        field.column = header.columns;
        field.offset = header.point_size;
        header.columns += field.count;
        header.point_size += field.count * field.size;
        header.fields.push_back(field);
    }
    if (header.point_size > kMaxPointSize)
        sizes.refuse("a point of " + std::to_string(header.point_size) + " bytes");
}

void checkCoordinates(const Entries& entries, const PcdHeader& header) {
    try {
        (void)rolesOf(header.fields);
    } catch (const std::runtime_error& e) {
        require(entries, "FIELDS").refuse(e.what());
    }
}

void readPointCount(const Entries& entries, PcdHeader& header) {
    const Entry* points = find(entries, "POINTS");
    if (points) header.points = points->number(0, kMaxPoints);
    if (!points || find(entries, "WIDTH") || find(entries, "HEIGHT")) {
        const std::size_t width = require(entries, "WIDTH").number(0, kMaxPoints);
        const Entry* height_entry = find(entries, "HEIGHT");
        const std::size_t height = height_entry ? height_entry->number(0, 1u << 20) : 1;
        if (height > 0 && width > kMaxPoints / height)
            require(entries, "WIDTH")
                .refuse("WIDTH times HEIGHT is more than " + std::to_string(kMaxPoints) +
                        " points");
        if (!points) header.points = width * height;
        if (header.points != width * height) points->refuse("POINTS is not WIDTH times HEIGHT");
    }
}

void readViewpoint(const Entries& entries, PcdHeader& header) {
    const Entry* viewpoint = find(entries, "VIEWPOINT");
    if (!viewpoint) return;
    if (viewpoint->words.size() != 7) viewpoint->refuse("expected 7 numbers, tx ty tz qw qx qy qz");
    header.viewpoint.emplace();
    auto& [translation, rotation] = *header.viewpoint;
    for (std::size_t i = 0; i < 7; i++) {
        double& value = i < 3 ? translation[i] : rotation[i - 3];
        if (!parseNumber(std::string_view(viewpoint->words[i]), value) || !std::isfinite(value))
            viewpoint->refuse("'" + viewpoint->words[i] + "' is not a finite number");
    }
    const double norm =
        std::hypot(std::hypot(rotation[0], rotation[1]), std::hypot(rotation[2], rotation[3]));
    if (std::abs(norm - 1) > 0.05)
        viewpoint->refuse("qw qx qy qz is not a unit quaternion: its norm is " +
                          std::to_string(norm));
    for (double& q : rotation) q /= norm;
}

void readDataKind(const Entries& entries, PcdHeader& header) {
    const Entry& entry = require(entries, "DATA");
    const std::string kind = entry.words.size() == 1 ? entry.words.front() : "";
    if (kind == "ascii")
        header.data = PcdHeader::Data::ascii;
    else if (kind == "binary")
        header.data = PcdHeader::Data::binary;
    else if (kind == "binary_compressed")
        header.data = PcdHeader::Data::binary_compressed;
    else
        entry.refuse("DATA must be ascii, binary or binary_compressed");
}

}  // namespace

PcdHeader readPcdHeader(std::istream& in) {
    PcdHeader header;
    const Entries entries = readEntries(in, header.lines);
    readFields(entries, header);
    checkCoordinates(entries, header);
    readPointCount(entries, header);
    readViewpoint(entries, header);
    readDataKind(entries, header);
    return header;
}

}  // namespace akimap::app
