// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <akimap/AkiMap.h>

#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "input/ScanSource.h"
#include "mapping/RealtimeGate.h"

namespace akimap::app {

/** What `akimap build` did. */
struct BuildReport {
    InsertionStats insertion;
    SkippedScans skipped;
    uint64_t empty_scans = 0;              ///< without a point that the map could use
    uint64_t cells = 0;                    ///< with evidence
    uint64_t map_bytes = 0;                ///< the map's own memory: blocks, index, slack
    std::vector<double> update_seconds;    ///< wall time of each insertion, reading left out
    std::optional<RealtimeGate> realtime;  ///< what was lost; empty: every scan was inserted
    bool interrupted = false;              ///< by ^C: the later scans are missing
    uint64_t peak_rss_bytes = 0;           ///< of the whole process
};

/** One thing passed over: its JSON key, its name for people, and how many. */
struct SkipCount {
    std::string key, name;
    uint64_t count = 0;
};

/** All skip counters, zero or not, and one for each unusable class that was seen. */
[[nodiscard]] std::vector<SkipCount> skipCounts(const BuildReport& report);

/** An aligned table for people, with the counters that are not zero. */
void printTable(const BuildReport& report, std::ostream& out);

/** Flat JSON: times in seconds, memory in bytes, all counters.
 * \exception std::runtime_error naming the file */
void writeJson(const BuildReport& report, const std::string& file);

[[nodiscard]] uint64_t peakMemoryBytes();

}  // namespace akimap::app
