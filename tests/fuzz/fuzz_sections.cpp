// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
// Maps of format 3 with right checksums around anything: the bytes are sections, each 4 bytes of
// tag, 1 of flags, 2 of size and so many of payload.
#include <akimap/AkiMap.h>

#include <algorithm>

#include "fuzz.h"
#include "grid/sections.h"
#include "reload.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, std::size_t size) {
    std::string map =
        "\x8e"
        "akimap::AkiMap\3";
    const akimap::WriteBytes append = [&](const void* from, std::size_t n) {
        map.append(static_cast<const char*>(from), n);
    };
    for (std::size_t at = 0; at + 7 <= size;) {
        const uint8_t* head = bytes + at;
        const akimap::Tag tag{static_cast<char>(head[0]), static_cast<char>(head[1]),
                              static_cast<char>(head[2]), static_cast<char>(head[3])};
        at += 7;
        const std::size_t n = std::min<std::size_t>(head[5] | head[6] << 8, size - at);
        akimap::writeTextSection(append, tag,
                                 head[4] & 1 ? akimap::Need::required : akimap::Need::optional,
                                 std::string(reinterpret_cast<const char*>(bytes) + at, n));
        at += n;
    }
    map += '\x88';
    return fuzz(reinterpret_cast<const uint8_t*>(map.data()), map.size(), [](const std::string& p) {
        requireSameAfterReload(*akimap::AkiMap::loadFromFile(p));
    });
}
