// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "mapping/build_map.h"

#include <mrpt/core/Clock.h>
#include <mrpt/core/format.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <stdexcept>

#include "checking/ScanSurvey.h"
#include "errors.h"
#include "input/ProgressBar.h"
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
    std::vector<std::string> outputs = request.exports, read = filesRead(request.input);
    outputs.insert(outputs.end(), {request.output, request.json});
    read.push_back(request.map.config);
    checkOutputs(outputs, read);
    for (const std::string& file : request.exports) checkExportable(file);
}

/** When the scan comes [s]. */
double stampOf(const Scan& scan, uint64_t number, double rate) {
    if (rate > 0) return static_cast<double>(number) / rate;
    const auto time = timeOf(scan);
    if (!time)
        throw std::runtime_error("a scan without a time stamp; --realtime needs --rate for it");
    return mrpt::Clock::toDouble(*time);
}

/** Inserts the scans, and counts. */
void insertScans(AkiMap& map, ScanFeed& feed, const BuildRequest& request, BuildReport& report,
                 ScanSurvey& survey) {
    if (request.realtime) report.realtime.emplace();
    const bool is_checked = !request.input.poses.empty() && !request.realtime;
    constexpr uint64_t kChecked = 100;  // scans: poses that are wrong are so from the start
    const auto take = [&](const Scan& scan, uint64_t number) {
        if (is_checked && number < kChecked) survey.add(scan, raysOf(scan, false));
        if (report.realtime && !report.realtime->offer(stampOf(scan, number, request.rate))) return;
        using Clock = std::chrono::steady_clock;
        const auto start = Clock::now();
        if (!insertScan(map, scan)) report.empty_scans++;
        const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
        report.update_seconds.push_back(seconds);
        if (report.realtime) report.realtime->used(seconds);
    };
    std::optional<StopSignal> stop;
    if (!request.input.follow && request.on_interrupt == "save") stop.emplace();
    feed.forEachScan(take, !request.quiet);
    report.interrupted = stop && StopSignal::requested();
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

/** Tells, with the remedy, of what makes maps wrong or poor although nothing failed. */
void warnOfPoorMap(const AkiMap& map, const ScanFeed& feed, const ScanSurvey& survey) {
    constexpr std::size_t kEnough = 1000;  // cells that scans have in common
    if (survey.compared() > kEnough)
        for (const std::string& line : survey.mismatches())
            warn(line + " (akimap check tells more)");
    if (feed.isFixed())
        warn(
            "all scans were taken from one and the same pose; if the sensor moved, --poses FILE "
            "tells where it was");
    const akimap::InsertionStats s = map.stats();
    const double dropped = static_cast<double>(s.dropped_range) / static_cast<double>(s.rays);
    const double max_range = map.insertionOptions.max_range;
    if (dropped > 0.3 && max_range == akimap::InsertionParameters().max_range)
        warn(
            mrpt::format("%.0f %% of the returns are out of range, most beyond --max-range %g m, "
                         "the default; --max-range 30 or more suits lidars, with larger cells "
                         "(--resolution 0.1)",
                         100 * dropped, max_range));
}

/** The map first: what the exports refuse must not cost it. */
void saveAndExport(const AkiMap& map, const BuildRequest& request) {
    {
        const StageLine stage("writing " + request.output, !request.quiet);
        map.saveToFile(request.output);
    }
    for (const std::string& target : request.exports) {
        const StageLine stage("exporting " + target, !request.quiet);
        exportMap(map, target);
    }
}

void build(const BuildRequest& request, AkiMap& map, BuildReport& report) {
    ScanFeed feed(request.input);
    ScanSurvey survey(1000);
    insertScans(map, feed, request, report, survey);
    if (map.isEmpty()) {
        if (report.interrupted)
            throw Interrupted("interrupted before the first scan was in the map; nothing written");
        refuseNothing(report, feed);
    }
    warnOfPoorMap(map, feed, survey);
    report.cells = map.cellCount();
    report.map_bytes = map.memoryBytes();
    saveAndExport(map, request);
    report.peak_rss_bytes = peakMemoryBytes();
    if (!request.json.empty()) writeJson(report, request.json);
    if (!request.quiet) printTable(report, std::cout);
    if (report.interrupted)
        throw Interrupted("interrupted: " + request.output + " holds the first " +
                          std::to_string(report.insertion.scans) + " scans");
}

}  // namespace

void buildMap(const BuildRequest& request) {
    AkiMap map = makeMapFor(request.map);
    BuildReport report;
    std::vector<std::string> others = filesRead(request.input);
    others.insert(others.end(), request.exports.begin(), request.exports.end());
    others.insert(others.end(), {request.output, request.map.config});
    withErrorsInJson(request.json, others, [&] {
        checkRequest(request);
        build(request, map, report);
    });
}

}  // namespace akimap::app
