// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "fuzz.h"
#include "mapping/config.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, std::size_t size) {
    return fuzz(bytes, size, [](const std::string& path) {
        (void)akimap::app::makeMap(akimap::app::loadConfig(path, "map"));
    });
}
