// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "input/PcdReader.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "input/PcdHeader.h"
#include "input/files.h"
#include "input/lzf.h"
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

double readFloat(const uint8_t* bytes, std::size_t size) {
    if (size == 8) {
        double value = 0;
        std::memcpy(&value, bytes, 8);
        return value;
    }
    float value = 0;
    std::memcpy(&value, bytes, 4);
    return value;
}

std::vector<Ray> readAscii(OpenPcd& pcd) {
    const PcdHeader& h = pcd.header;
    std::vector<Ray> rays;
    rays.reserve(h.points);
    std::vector<std::string_view> words;
    std::string line;
    for (std::size_t number = h.lines + 1; std::getline(pcd.in, line); number++) {
        const auto refuse = [&](const std::string& what) {
            throw std::runtime_error("line " + std::to_string(number) + ": " + what);
        };
        splitWords(line, words);
        if (words.empty()) continue;
        if (rays.size() == h.points)
            refuse("more than the " + std::to_string(h.points) + " points of the header");
        if (words.size() != h.columns)
            refuse("expected " + std::to_string(h.columns) + " numbers and found " +
                   std::to_string(words.size()));
        Ray ray{h.origin, {}};
        for (std::size_t axis = 0; axis < 3; axis++) {
            const auto word = words[h.fields[h.xyz[axis]].column];
            if (!parseNumber(word, ray.end[axis]))
                refuse("'" + std::string(word) + "' is not a number");
        }
        rays.push_back(ray);
    }
    if (rays.size() != h.points)
        throw std::runtime_error("the data end at byte " + std::to_string(pcd.size) + " after " +
                                 std::to_string(rays.size()) + " of " + std::to_string(h.points) +
                                 " points");
    return rays;
}

std::vector<Ray> readBinary(OpenPcd& pcd) {
    const PcdHeader& h = pcd.header;
    // No more than there are: a point may claim a megabyte, and only their sum is in the file.
    const std::size_t points_at_once = std::min<std::size_t>(16384, h.points);
    std::vector<uint8_t> buffer(points_at_once * h.point_size);
    std::vector<Ray> rays(h.points, Ray{h.origin, {}});
    for (std::size_t first = 0; first < h.points; first += points_at_once) {
        const std::size_t n = std::min(points_at_once, h.points - first);
        pcd.in.read(reinterpret_cast<char*>(buffer.data()),
                    static_cast<std::streamsize>(n * h.point_size));
        if (!pcd.in) refuseShort(pcd, h.points * h.point_size);
        for (std::size_t axis = 0; axis < 3; axis++) {
            const auto& field = h.fields[h.xyz[axis]];
            for (std::size_t i = 0; i < n; i++)
                rays[first + i].end[axis] =
                    readFloat(&buffer[i * h.point_size + field.offset], field.size);
        }
    }
    return rays;
}

std::vector<Ray> readCompressed(OpenPcd& pcd) {
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
    std::vector<Ray> rays(h.points, Ray{h.origin, {}});
    for (std::size_t axis = 0; axis < 3; axis++) {
        const auto& field = h.fields[h.xyz[axis]];
        for (std::size_t i = 0; i < h.points; i++)
            rays[i].end[axis] =
                readFloat(&data[field.offset * h.points + i * field.size], field.size);
    }
    return rays;
}

}  // namespace

std::vector<Ray> readPcd(const std::string& file) {
    requireReadable(file);
    try {
        OpenPcd pcd = openPcd(file);
        switch (pcd.header.data) {
            case PcdHeader::Data::ascii:
                return readAscii(pcd);
            case PcdHeader::Data::binary:
                return readBinary(pcd);
            case PcdHeader::Data::binary_compressed:
                return readCompressed(pcd);
        }
        return {};
    } catch (const std::runtime_error& e) {
        throw std::runtime_error(file + ": " + e.what());
    }
}

void checkPcd(const std::string& file) {
    requireReadable(file);
    try {
        openPcd(file);
    } catch (const std::runtime_error& e) {
        throw std::runtime_error(file + ": " + e.what());
    }
}

}  // namespace akimap::app
