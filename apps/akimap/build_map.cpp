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
#include <optional>
#include <set>
#include <stdexcept>

#include "ProgressBar.h"
#include "StopSignal.h"
#include "build_report.h"
#include "config.h"
#include "errors.h"
#include "input/FollowSource.h"
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
    if (!(std::isfinite(request.idle) && request.idle > 0))
        throw std::runtime_error("--idle must be finite and > 0");
    std::vector<std::string> outputs = request.exports;
    outputs.push_back(request.output);
    if (!request.json.empty()) outputs.push_back(request.json);
    std::error_code ignored;
    if (std::filesystem::path(request.output).extension() != ".akimap")
        throw std::runtime_error(
            request.output + ": the map's name must end with .akimap (other formats: --export)");
    std::set<std::string> taken = {request.config, request.trajectory};
    for (const std::string& output : outputs) {
        if (!taken.insert(output).second && output.rfind("/dev/", 0) != 0)
            throw std::runtime_error(output + ": would be overwritten, it is named twice");
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
    for (std::size_t i = 0; i < request.inputs.size(); i++) {
        const bool is_followed = request.follow && i + 1 == request.inputs.size();
        sources.push_back(is_followed ? followSource(request.inputs[i], options,
                                                     {request.idle, StopSignal::requested})
                                      : openSource(request.inputs[i], options));
    }
    if (options.trajectory && !request.follow)
        requireCoverage(request, *options.trajectory, sources);
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
    if (request.follow) total = ProgressBar::kUnknown;
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
    std::optional<StopSignal> stop;
    if (request.follow) stop.emplace();
    const Sources sources = openSources(request);
    BuildReport report;
    insertScans(map, sources, request, report);
    stop.reset();
    if (map.isEmpty()) refuseNothing(report, request, sources);

    report.cells = map.cellCount();
    report.map_bytes = map.grid().memoryBytes();
    AtomicFile file(request.output);
    map.saveToFile(file.path());
    for (const std::string& target : request.exports) exportMap(map, target);
    file.commit();  // not before the exports: what they refuse leaves an older map as it was
    report.peak_rss_bytes = peakMemoryBytes();
    if (!request.json.empty()) writeJson(report, request.json);
    if (!request.quiet) printTable(report, std::cout);
}

}  // namespace akimap::app
