// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include "fuzz.h"
#include "input/ScanSource.h"

/** Reads logs of MRPT's objects, which are read in a process of their own: what crashes there is
 * contained, and no finding. Neither sees libFuzzer what that covers.
 * \param extension by which the reader is chosen */
inline int fuzzLog(const uint8_t* bytes, std::size_t size, const std::string& extension) {
    static const std::string name = "/tmp/akimap-fuzz-" + std::to_string(getpid()) + extension;
    static const int removed_at_exit = std::atexit([] { unlink(name.c_str()); });
    (void)removed_at_exit;
    return fuzz(bytes, size, [](const std::string& path) {
        unlink(name.c_str());
        if (symlink(path.c_str(), name.c_str()) != 0) std::abort();
        akimap::app::InputOptions options;
        options.warn = [](const std::string&) {};
        akimap::app::SkippedScans skipped;
        try {
            const auto source = akimap::app::openSource(name, options);
            source->forEachScan([](akimap::app::Scan&) { return true; }, skipped);
        } catch (const std::exception& e) {
            if (std::string(e.what()).find(name) == std::string::npos) std::abort();
        }
    });
}
