// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <akimap/AkiMap.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/serialization/CArchive.h>

#include <functional>
#include <string>
#include <string_view>

#include "grid/BlockGrid.h"

namespace akimap::test {

inline std::string fingerprint(const char* data, std::size_t size) {
    return std::to_string(size) + ":" + std::to_string(std::hash<std::string_view>()({data, size}));
}

/** The map's serialization. */
inline std::string bytes(const AkiMap& map) {
    mrpt::io::CMemoryStream stream;
    auto archive = mrpt::serialization::archiveFrom(stream);
    archive << map;
    return {static_cast<const char*>(stream.getRawBufferData()), stream.getTotalBytesCount()};
}

/** Equal for equal maps: everything, bit for bit, random state included. */
inline std::string fingerprint(const AkiMap& map) {
    const std::string all = bytes(map);
    return fingerprint(all.data(), all.size());
}

/** Equal for equal cells. */
inline std::string cellsFingerprint(const AkiMap& map) {
    std::string all;
    const auto append = [&](const auto& v) {
        all.append(reinterpret_cast<const char*>(&v), sizeof v);
    };
    map.grid().forEachCell(
        [&](const CellIndex& c, float a, float b) { append(c), append(a), append(b); });
    return fingerprint(all.data(), all.size());
}

}  // namespace akimap::test
