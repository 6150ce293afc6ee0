// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "build_map.h"

#include <mrpt/core/Clock.h>
#include <mrpt/system/datetime.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <limits>
#include <stdexcept>

#include "ProgressBar.h"
#include "build_report.h"
#include "config.h"
#include "errors.h"
#include "input/RawlogSource.h"
#include "output/AtomicFile.h"
#include "output/export_map.h"

namespace akimap::app {

namespace {

using Sources = std::vector<std::unique_ptr<ScanSource>>;

AkiMap makeMapFor(const BuildRequest& request) {
    AkiMap::TMapDefinition definition = request.config.empty()
                                            ? AkiMap::TMapDefinition()
                                            : loadConfig(request.config, request.section);
    for (const auto& set : request.settings) set(definition);
    AkiMap map = makeMap(definition);
    if (!map.genericMapParams.enableObservationInsertion)
        throw std::runtime_error(request.config +
                                 ": enableObservationInsertion = false leaves nothing to build");
    return map;
}

void checkRequest(const BuildRequest& request) {
    if (!(std::isfinite(request.max_gap) && request.max_gap > 0))
        throw std::runtime_error("--max-gap must be finite and > 0");
    std::vector<std::string> outputs = request.exports;
    outputs.push_back(request.output);
    if (!request.json.empty()) outputs.push_back(request.json);
    std::error_code ignored;
    for (const std::string& output : outputs) {
        AtomicFile::checkWritable(output);
        for (const std::string& input : request.inputs)
            if (std::filesystem::equivalent(input, output, ignored))
                throw std::runtime_error(output + ": this output is an input too");
    }
    for (const std::string& file : request.exports) checkExportable(file);
}

/** \exception std::runtime_error if the given trajectory has no pose for any scan of any rawlog */
void requireCoverage(const BuildRequest& request, const RobotPath& path, const Sources& sources) {
    bool has_rawlog = false, has_uncovered = false;
    for (const auto& source : sources) {
        const auto* rawlog = dynamic_cast<const RawlogSource*>(source.get());
        if (!rawlog) continue;
        if (rawlog->scanCount() > 0) return;
        has_rawlog = true;
        has_uncovered |= rawlog->uncoveredCount() > 0;
    }
    if (has_rawlog && !has_uncovered) return;  // there are no scans at all
    const auto text = [](auto time) { return std::to_string(mrpt::Clock::toDouble(time)); };
    throw std::runtime_error(request.trajectory + ": covers no scan of the inputs: it goes from " +
                             text(path.samples().front().time) + " to " +
                             text(path.samples().back().time) + " s");
}

Sources openSources(const BuildRequest& request) {
    InputOptions options;
    options.max_gap = request.max_gap;
    options.only_label = request.only_label;
    options.partial = request.partial;
    options.warn = [](const std::string& line) {
        std::cerr << "akimap: warning: " << line << "\n";
    };
    if (!request.trajectory.empty())
        options.trajectory = std::make_shared<const RobotPath>(
            RobotPath::loadTum(request.trajectory, request.max_gap));
    Sources sources;
    for (const std::string& file : request.inputs) sources.push_back(openSource(file, options));
    if (options.trajectory) requireCoverage(request, *options.trajectory, sources);
    return sources;
}

bool insertScan(AkiMap& map, const Scan& scan) {
    if (!scan.observation) return map.insertRays(scan.rays);
    if (!scan.motion) return map.insertObservation(*scan.observation, scan.robot_pose);
    return map.insertMovingObservation(
        *scan.observation, [&](mrpt::Clock::time_point time) { return scan.motion->at(time); });
}

/** Inserts all scans, or the first so many, and counts. */
void insertScans(AkiMap& map, const Sources& sources, const BuildRequest& request,
                 BuildReport& report) {
    const uint64_t wanted = request.first ? request.first : std::numeric_limits<uint64_t>::max();
    uint64_t total = 0, done = 0;
    for (const auto& source : sources) total += source->scanCount();
    ProgressBar bar(std::min(total, wanted), !request.quiet);
    const auto take = [&](Scan& scan) {
        using Clock = std::chrono::steady_clock;
        const auto start = Clock::now();
        if (!insertScan(map, scan)) report.empty_scans++;
        report.insertion_seconds += std::chrono::duration<double>(Clock::now() - start).count();
        bar.show(++done);
        return done < wanted;
    };
    for (const auto& source : sources) {
        if (done == wanted) break;
        try {
            source->forEachScan(take, report.skipped);
        } catch (const std::exception& e) {
            const std::string what = reasonOf(e.what());
            const bool is_named = what.find(source->file()) != std::string::npos;
            throw std::runtime_error(is_named ? what : source->file() + ": " + what);
        }
    }
    report.insertion = map.stats();
}

[[noreturn]] void refuseNothing(const BuildReport& report, const BuildRequest& request,
                                const Sources& sources) {
    std::string skipped, labels;
    for (const SkipCount& skip : skipCounts(report))
        if (skip.count > 0)
            skipped +=
                (skipped.empty() ? ": " : ", ") + std::to_string(skip.count) + " " + skip.name;
    for (const auto& source : sources)
        for (const std::string& label : source->labels())
            labels += (labels.empty() ? "" : ", ") + label;
    if (report.skipped.other_label > 0)
        skipped += "; --only " + request.only_label + ", but the sensors are: " + labels;
    throw std::runtime_error("nothing usable in the inputs" + skipped);
}

}  // namespace

void buildMap(const BuildRequest& request) {
    AkiMap map = makeMapFor(request);
    checkRequest(request);
    const Sources sources = openSources(request);
    BuildReport report;
    insertScans(map, sources, request, report);
    if (map.isEmpty()) refuseNothing(report, request, sources);

    report.cells = map.cellCount();
    report.map_bytes = map.grid().memoryBytes();
    map.saveToFile(request.output);
    for (const std::string& file : request.exports) exportMap(map, file);
    report.peak_rss_bytes = peakMemoryBytes();
    if (!request.json.empty()) writeJson(report, request.json);
    if (!request.quiet) printTable(report, std::cout);
}

}  // namespace akimap::app
