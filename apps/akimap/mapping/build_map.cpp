// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "mapping/build_map.h"

#include <mrpt/core/Clock.h>
#include <mrpt/system/datetime.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <stdexcept>

#include "mapping/build_report.h"
#include "output/export_map.h"
#include "output/outputs.h"

namespace akimap::app {

namespace {

void checkRequest(const BuildRequest& request) {
    checkInputOptions(request.input);
    if (!(std::isfinite(request.rate) && request.rate >= 0))
        throw std::runtime_error("--rate must be finite and > 0");
    if (std::filesystem::path(request.output).extension() != ".akimap")
        throw std::runtime_error(
            request.output + ": the map's name must end with .akimap (other formats: --export)");
    std::vector<std::string> outputs = request.exports, read = request.input.inputs;
    outputs.insert(outputs.end(), {request.output, request.json});
    read.insert(read.end(), {request.map.config, request.input.trajectory});
    checkOutputs(outputs, read);
    for (const std::string& file : request.exports) checkExportable(file);
}

/** When the scan comes [s]. */
double stampOf(const Scan& scan, uint64_t number, double rate) {
    if (rate > 0) return static_cast<double>(number) / rate;
    if (!scan.observation || scan.observation->timestamp == INVALID_TIMESTAMP)
        throw std::runtime_error("a scan without a time stamp; --realtime needs --rate for it");
    return mrpt::Clock::toDouble(scan.observation->timestamp);
}

/** Inserts the scans, and counts. */
void insertScans(AkiMap& map, ScanFeed& feed, const BuildRequest& request, BuildReport& report) {
    if (request.realtime) report.realtime.emplace();
    const auto take = [&](const Scan& scan, uint64_t number) {
        if (report.realtime && !report.realtime->offer(stampOf(scan, number, request.rate))) return;
        using Clock = std::chrono::steady_clock;
        const auto start = Clock::now();
        if (!insertScan(map, scan)) report.empty_scans++;
        const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
        report.update_seconds.push_back(seconds);
        if (report.realtime) report.realtime->used(seconds);
    };
    feed.forEachScan(take, !request.quiet);
    report.insertion = map.stats();
    report.skipped = feed.skipped();
}

[[noreturn]] void refuseNothing(const BuildReport& report, const ScanFeed& feed) {
    std::string skipped;
    for (const SkipCount& skip : skipCounts(report))
        if (skip.count > 0)
            skipped +=
                (skipped.empty() ? ": " : ", ") + std::to_string(skip.count) + " " + skip.name;
    const std::string hint = feed.wrongLabelHint();
    throw std::runtime_error("nothing usable in the inputs" + skipped +
                             (hint.empty() ? "" : "; " + hint));
}

}  // namespace

void buildMap(const BuildRequest& request) {
    AkiMap map = makeMapFor(request.map);
    checkRequest(request);
    ScanFeed feed(request.input);
    BuildReport report;
    insertScans(map, feed, request, report);
    if (map.isEmpty()) refuseNothing(report, feed);

    report.cells = map.cellCount();
    report.map_bytes = map.memoryBytes();
    for (const std::string& target : request.exports) exportMap(map, target);
    map.saveToFile(request.output);  // last: what the exports refuse leaves an older map as it was
    report.peak_rss_bytes = peakMemoryBytes();
    if (!request.json.empty()) writeJson(report, request.json);
    if (!request.quiet) printTable(report, std::cout);
}

}  // namespace akimap::app
