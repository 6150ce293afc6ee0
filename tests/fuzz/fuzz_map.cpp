// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
// Whole map files, of any format. Format 3 has checksums: see fuzz_sections.
#include <akimap/AkiMap.h>

#include "fuzz.h"
#include "reload.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, std::size_t size) {
    return fuzz(bytes, size, [](const std::string& path) {
        requireSameAfterReload(*akimap::AkiMap::loadFromFile(path));
    });
}
