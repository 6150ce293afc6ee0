// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "mapping/build_report.h"

#include <mrpt/core/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <numeric>
#include <ostream>

#include "quantile.h"
#include "support/AtomicFile.h"

namespace akimap::app {

namespace {

void row(std::ostream& out, const std::string& name, const std::string& value) {
    out << mrpt::format("%-38s %14s\n", name.c_str(), value.c_str());
}

std::string countText(uint64_t count) {
    return mrpt::format("%llu", static_cast<unsigned long long>(count));
}

std::string secondsText(double seconds) {
    return mrpt::format("%.3f", seconds);
}

double sumOf(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
}

}  // namespace

std::vector<SkipCount> skipCounts(const BuildReport& report) {
    const InsertionStats& s = report.insertion;
    std::vector<SkipCount> counts{
        {"skipped_points_nonfinite", "points not finite", s.dropped_nonfinite},
        {"skipped_points_zero_length", "points at their ray's origin", s.dropped_zero},
        {"skipped_points_range", "points out of range", s.dropped_range},
        {"skipped_points_grid", "points beyond the grid", s.dropped_grid},
        {"skipped_packets_trajectory", "packets outside the trajectory", s.dropped_poses},
        {"skipped_points_trajectory", "points outside the trajectory",
         report.skipped.points_outside_trajectory},
        {"skipped_scans_empty", "scans without a usable point", report.empty_scans},
        {"skipped_scans_trajectory", "scans outside the trajectory",
         report.skipped.outside_trajectory},
        {"skipped_scans_label", "scans of other sensors", report.skipped.other_label}};
    for (const auto& [name, count] : report.skipped.unusable)
        counts.push_back({"skipped_observations_" + name, name + " (unusable)", count});
    return counts;
}

void printTable(const BuildReport& report, std::ostream& out) {
    const InsertionStats& s = report.insertion;
    row(out, "scans", countText(s.scans));
    row(out, "points", countText(s.points));
    if (s.free_beams) row(out, "beams without a hit", countText(s.free_beams));
    row(out, "occupied samples", countText(s.samples_occupied));
    row(out, "free samples", countText(s.samples_free));
    row(out, "cells", countText(report.cells));
    row(out, "map [MB]", mrpt::format("%.1f", static_cast<double>(report.map_bytes) / 1e6));
    row(out, "insertion time [s]", secondsText(sumOf(report.update_seconds)));
    row(out, "  of a scan, median", secondsText(quantile(report.update_seconds, 0.5)));
    row(out, "  of a scan, 99th percentile", secondsText(quantile(report.update_seconds, 0.99)));
    if (report.realtime) {
        row(out, "scans offered", countText(report.realtime->offered()));
        row(out, "  used", countText(report.realtime->used()));
        row(out, "  lost", countText(report.realtime->lost()));
        if (const auto late = report.realtime->lostOutOfOrder())
            row(out, "    of them out of order", countText(late));
    }
    bool is_first = true;
    for (const SkipCount& skip : skipCounts(report)) {
        if (skip.count == 0) continue;
        if (is_first) out << "skipped:\n";
        is_first = false;
        row(out, "  " + skip.name, countText(skip.count));
    }
}

void writeJson(const BuildReport& report, const std::string& file) {
    const InsertionStats& s = report.insertion;
    nlohmann::ordered_json json{{"scans", s.scans},
                                {"points", s.points},
                                {"free_beams", s.free_beams},
                                {"samples_occupied", s.samples_occupied},
                                {"samples_free", s.samples_free},
                                {"cells", report.cells},
                                {"map_bytes", report.map_bytes},
                                {"insertion_seconds", sumOf(report.update_seconds)},
                                {"update_seconds_median", quantile(report.update_seconds, 0.5)},
                                {"update_seconds_p99", quantile(report.update_seconds, 0.99)},
                                {"seconds_sampling", s.seconds_sampling},
                                {"seconds_bandwidth", s.seconds_bandwidth},
                                {"seconds_update", s.seconds_update},
                                {"peak_rss_bytes", report.peak_rss_bytes}};
    if (report.realtime) {
        json["scans_offered"] = report.realtime->offered();
        json["scans_used"] = report.realtime->used();
        json["scans_lost"] = report.realtime->lost();
        json["scans_lost_out_of_order"] = report.realtime->lostOutOfOrder();
    }
    if (report.interrupted) json["interrupted"] = true;
    uint64_t unusable = 0;
    for (const auto& [name, count] : report.skipped.unusable) unusable += count;
    json["skipped_observations"] = unusable;
    for (const SkipCount& skip : skipCounts(report)) json[skip.key] = skip.count;
    writeWhole(file, json.dump(2) + "\n");
}

uint64_t peakMemoryBytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<uint64_t>(usage.ru_maxrss) * 1024;
}

}  // namespace akimap::app
