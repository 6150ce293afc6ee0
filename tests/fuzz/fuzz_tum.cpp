// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "input/poses/RobotPath.h"

#include "fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, std::size_t size) {
    return fuzz(bytes, size, [](const std::string& path) {
        const auto poses = akimap::app::RobotPath::loadTum(path, 0.5);
        for (const auto& sample : poses.samples())
            if (!poses.at(sample.time)) std::abort();
    });
}
