// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <stdexcept>

#include "fuzz.h"
#include "mapping/config.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, std::size_t size) {
    return fuzz(bytes, size, [](const std::string& path) {
        const auto definition = akimap::app::loadConfig(path, "map");
        try {
            (void)akimap::app::makeMap(definition);
        } catch (const std::invalid_argument&) {  // names parameters that do not fit together
        }
    });
}
