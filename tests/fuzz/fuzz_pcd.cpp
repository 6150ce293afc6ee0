// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "input/clouds/PcdReader.h"

#include "fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, std::size_t size) {
    return fuzz(bytes, size, [](const std::string& path) { (void)akimap::app::readPcd(path); });
}
