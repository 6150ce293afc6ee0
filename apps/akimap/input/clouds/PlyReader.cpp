// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "input/clouds/PlyReader.h"

#include <array>
#include <filesystem>
#include <fstream>
#include <map>
#include <stdexcept>

#include "input/clouds/PointFields.h"
#include "input/files.h"
#include "input/numbers.h"

namespace akimap::app {

namespace {

enum class Format { ascii, little_endian, big_endian };

struct OpenPly {
    std::ifstream in;
    Format format = Format::ascii;
    std::vector<PointField> fields;  // of a vertex
    std::size_t points = 0, point_size = 0, columns = 0;
    std::size_t lines = 0;                 // in the header
    std::size_t size = 0, data_start = 0;  // [bytes]
};

[[noreturn]] void refuseLine(std::size_t line, const std::string& what) {
    throw std::runtime_error("line " + std::to_string(line) + ": " + what);
}

/** The type of a property by its name, old or new. */
PointField fieldOf(std::size_t line, const std::string& type, const std::string& name) {
    struct Kind {
        char type;
        std::size_t size;
    };
    static const std::map<std::string, Kind> kinds{
        {"char", {'I', 1}},  {"int8", {'I', 1}},    {"uchar", {'U', 1}},  {"uint8", {'U', 1}},
        {"short", {'I', 2}}, {"int16", {'I', 2}},   {"ushort", {'U', 2}}, {"uint16", {'U', 2}},
        {"int", {'I', 4}},   {"int32", {'I', 4}},   {"uint", {'U', 4}},   {"uint32", {'U', 4}},
        {"float", {'F', 4}}, {"float32", {'F', 4}}, {"double", {'F', 8}}, {"float64", {'F', 8}}};
    const auto kind = kinds.find(type);
    if (kind == kinds.end()) refuseLine(line, "'" + type + "' is no type of a PLY property");
    PointField field;
    field.name = name;
    field.type = kind->second.type;
    field.size = kind->second.size;
    return field;
}

/** Takes one line of the header. \param element the one that its properties belong to */
void takeLine(OpenPly& ply, const std::vector<std::string_view>& words, std::string& element) {
    const std::string key(words.front());
    if (key == "comment" || key == "obj_info" || key == "ply") return;
    const auto want = [&](std::size_t count) {
        if (words.size() != count) refuseLine(ply.lines, "not " + key + " as PLY has it");
    };
    if (key == "format") {
        want(3);
        if (words[1] != "ascii")
            ply.format =
                words[1] == "binary_big_endian" ? Format::big_endian : Format::little_endian;
    } else if (key == "element") {
        want(3);
        std::size_t count = 0;
        if (!parseNumber(words[2], count) || count > (std::size_t{1} << 40))
            refuseLine(ply.lines, "'" + std::string(words[2]) + "' is no number of elements");
        element = std::string(words[1]);
        if (element == "vertex")
            ply.points = count;
        else if (ply.fields.empty() && count > 0)
            refuseLine(ply.lines, "element " + element + " comes before the vertices");
    } else if (key == "property") {
        if (element != "vertex") return;
        want(3);  // a list has five words
        PointField field = fieldOf(ply.lines, std::string(words[1]), std::string(words[2]));
        field.column = ply.columns++;
        field.offset = ply.point_size;
        ply.point_size += field.size;
        ply.fields.push_back(field);
    } else {
        refuseLine(ply.lines, "a PLY header has no '" + key.substr(0, 20) + "'");
    }
}

OpenPly openPly(const std::string& file) {
    OpenPly ply;
    ply.in.open(file, std::ios::binary);
    ply.size = std::filesystem::file_size(file);
    std::string line, element;
    std::vector<std::string_view> words;
    for (;;) {
        ply.lines++;
        if (!std::getline(ply.in, line) || line.size() > 10000)
            refuseLine(ply.lines, "no end_header; this is not a whole PLY header");
        splitWords(line, words);
        if (ply.lines == 1 && (words.size() != 1 || words[0] != "ply"))
            refuseLine(1, "not a PLY file, whose first line is 'ply'");
        if (words.empty()) continue;
        if (words.front() == "end_header") break;
        takeLine(ply, words, element);
    }
    (void)rolesOf(ply.fields);
    ply.data_start = ply.in.good() ? static_cast<std::size_t>(ply.in.tellg()) : ply.size;
    const std::size_t least =
        ply.points * (ply.format == Format::ascii ? 2 * ply.columns : ply.point_size);
    if (least > ply.size - ply.data_start + 1)
        throw std::runtime_error("the data end at byte " + std::to_string(ply.size) + ", before " +
                                 std::to_string(ply.points) + " points can");
    return ply;
}

void fillAscii(OpenPly& ply, CloudFiller& filler) {
    std::vector<std::string_view> words;
    std::string line;
    std::size_t number = ply.lines;
    for (std::size_t i = 0; i < ply.points;) {
        number++;
        if (!std::getline(ply.in, line))
            refuseLine(number, "the file ends after " + std::to_string(i) + " of " +
                                   std::to_string(ply.points) + " points");
        splitWords(line, words);
        if (words.empty()) continue;
        if (words.size() != ply.columns)
            refuseLine(number, "expected " + std::to_string(ply.columns) + " numbers and found " +
                                   std::to_string(words.size()));
        filler.add([&](const PointField& field) {
            double value = 0;
            if (!parseNumber(words[field.column], value))
                refuseLine(number, "'" + std::string(words[field.column]) + "' is not a number");
            return value;
        });
        i++;
    }
}

void fillBinary(OpenPly& ply, CloudFiller& filler) {
    std::vector<uint8_t> point(ply.point_size);
    for (std::size_t i = 0; i < ply.points; i++) {
        ply.in.read(reinterpret_cast<char*>(point.data()),
                    static_cast<std::streamsize>(point.size()));
        if (!ply.in)
            throw std::runtime_error("the data end at byte " + std::to_string(ply.size) +
                                     " after " + std::to_string(i) + " of " +
                                     std::to_string(ply.points) + " points");
        filler.add([&](const PointField& field) {
            return numberAt(&point[field.offset], field, ply.format == Format::big_endian);
        });
    }
}

template <class Read>
auto withPly(const std::string& file, Read&& read) {
    requireReadable(file);
    try {
        OpenPly ply = openPly(file);
        return read(ply);
    } catch (const std::runtime_error& e) {
        throw std::runtime_error(file + ": " + e.what());
    }
}

}  // namespace

Cloud readPlyCloud(const std::string& file) {
    return withPly(file, [](OpenPly& ply) {
        CloudFiller filler(ply.fields, ply.points);
        ply.format == Format::ascii ? fillAscii(ply, filler) : fillBinary(ply, filler);
        return std::move(filler.cloud());
    });
}

void checkPly(const std::string& file) {
    withPly(file, [](const OpenPly&) {});
}

}  // namespace akimap::app
