// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "input/clouds/PcdReader.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "input/clouds/PcdHeader.h"
#include "input/clouds/lzf.h"
#include "input/files.h"
#include "input/numbers.h"

namespace akimap::app {

namespace {

/** A PCD file, opened and read up to its data. */
struct OpenPcd {
    std::ifstream in;
    PcdHeader header;
    std::size_t size = 0;        // [bytes] of the file
    std::size_t data_start = 0;  // [bytes]
};

[[noreturn]] void refuseShort(const OpenPcd& pcd, std::size_t needed) {
    throw std::runtime_error("the data end at byte " + std::to_string(pcd.size) + ", but " +
                             std::to_string(pcd.header.points) + " points need " +
                             std::to_string(needed) + " bytes from byte " +
                             std::to_string(pcd.data_start));
}

OpenPcd openPcd(const std::string& file) {
    OpenPcd pcd;
    pcd.in.open(file, std::ios::binary);
    pcd.size = std::filesystem::file_size(file);
    pcd.header = readPcdHeader(pcd.in);
    // Behind a last DATA line without its newline the position is unknown, and no data follow.
    pcd.data_start = pcd.in.good() ? static_cast<std::size_t>(pcd.in.tellg()) : pcd.size;

    // An ascii point takes a digit and a blank for each number at least (the last may lack it).
    const PcdHeader& h = pcd.header;
    const std::size_t available = pcd.size - pcd.data_start;
    if (h.data == PcdHeader::Data::binary && h.points * h.point_size > available)
        refuseShort(pcd, h.points * h.point_size);
    if (h.data == PcdHeader::Data::ascii && h.points * h.columns * 2 > available + 1)
        refuseShort(pcd, h.points * h.columns * 2 - 1);
    return pcd;
}

void fillAscii(OpenPcd& pcd, CloudFiller& filler) {
    const PcdHeader& h = pcd.header;
    const auto& points = filler.cloud().points;
    std::vector<std::string_view> words;
    std::string line;
    for (std::size_t number = h.lines + 1; std::getline(pcd.in, line); number++) {
        const auto refuse = [&](const std::string& what) {
            throw std::runtime_error("line " + std::to_string(number) + ": " + what);
        };
        splitWords(line, words);
        if (words.empty()) continue;
        if (points.size() == h.points)
            refuse("more than the " + std::to_string(h.points) + " points of the header");
        if (words.size() != h.columns)
            refuse("expected " + std::to_string(h.columns) + " numbers and found " +
                   std::to_string(words.size()));
        filler.add([&](const PointField& field) {
            double value = 0;
            const auto word = words[field.column];
            if (!parseNumber(word, value)) refuse("'" + std::string(word) + "' is not a number");
            return value;
        });
    }
    if (points.size() != h.points)
        throw std::runtime_error("the data end at byte " + std::to_string(pcd.size) + " after " +
                                 std::to_string(points.size()) + " of " + std::to_string(h.points) +
                                 " points");
}

void fillBinary(OpenPcd& pcd, CloudFiller& filler) {
    const PcdHeader& h = pcd.header;
    // No more than there are: a point may claim a megabyte, and only their sum is in the file.
    const std::size_t points_at_once = std::min<std::size_t>(16384, h.points);
    std::vector<uint8_t> buffer(points_at_once * h.point_size);
    for (std::size_t first = 0; first < h.points; first += points_at_once) {
        const std::size_t n = std::min(points_at_once, h.points - first);
        pcd.in.read(reinterpret_cast<char*>(buffer.data()),
                    static_cast<std::streamsize>(n * h.point_size));
        if (!pcd.in) refuseShort(pcd, h.points * h.point_size);
        for (std::size_t i = 0; i < n; i++)
            filler.add([&](const PointField& field) {
                return numberAt(&buffer[i * h.point_size + field.offset], field);
            });
    }
}

void fillCompressed(OpenPcd& pcd, CloudFiller& filler) {
    const PcdHeader& h = pcd.header;
    uint32_t packed_size = 0, size = 0;
    pcd.in.read(reinterpret_cast<char*>(&packed_size), 4);
    pcd.in.read(reinterpret_cast<char*>(&size), 4);
    if (!pcd.in || packed_size > pcd.size - pcd.data_start - 8)
        refuseShort(pcd, std::size_t{packed_size} + 8);
    if (size != h.points * h.point_size)
        throw std::runtime_error("the data unpack to " + std::to_string(size) + " bytes, but " +
                                 std::to_string(h.points) + " points take " +
                                 std::to_string(h.points * h.point_size));
    std::vector<uint8_t> packed(packed_size);
    pcd.in.read(reinterpret_cast<char*>(packed.data()), packed_size);
    if (!pcd.in) refuseShort(pcd, std::size_t{packed_size} + 8);
    const std::vector<uint8_t> data = unpackLzf(packed, size);
    // Compressed points lie field by field: all x, then all y, ...
    for (std::size_t i = 0; i < h.points; i++)
        filler.add([&](const PointField& field) {
            return numberAt(&data[field.offset * h.points + i * field.size], field);
        });
}

/** Calls read(OpenPcd&) with the file's name put before what it throws. */
template <class Read>
auto withPcd(const std::string& file, Read&& read) {
    requireReadable(file);
    try {
        OpenPcd pcd = openPcd(file);
        return read(pcd);
    } catch (const std::runtime_error& e) {
        throw std::runtime_error(file + ": " + e.what());
    }
}

}  // namespace

Cloud readPcdCloud(const std::string& file) {
    return withPcd(file, [](OpenPcd& pcd) {
        CloudFiller filler(pcd.header.fields, pcd.header.points);
        switch (pcd.header.data) {
            case PcdHeader::Data::ascii:
                fillAscii(pcd, filler);
                break;
            case PcdHeader::Data::binary:
                fillBinary(pcd, filler);
                break;
            case PcdHeader::Data::binary_compressed:
                fillCompressed(pcd, filler);
                break;
        }
        filler.cloud().viewpoint = pcd.header.viewpoint;
        return std::move(filler.cloud());
    });
}

std::vector<Ray> readPcd(const std::string& file) {
    const Cloud cloud = readPcdCloud(file);
    const auto origin = cloud.viewpoint.value_or(PcdViewpoint()).translation;
    std::vector<Ray> rays;
    rays.reserve(cloud.points.size());
    for (const auto& point : cloud.points) rays.push_back({origin, point});
    return rays;
}

std::optional<PcdViewpoint> peekPcd(const std::string& file) {
    return withPcd(file, [](const OpenPcd& pcd) { return pcd.header.viewpoint; });
}

}  // namespace akimap::app
