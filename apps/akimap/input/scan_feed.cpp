// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "input/scan_feed.h"

#include <akimap/rays.h>
#include <mrpt/core/Clock.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <stdexcept>

#include "cli.h"
#include "errors.h"
#include "input/FollowSource.h"
#include "input/ProgressBar.h"
#include "input/RawlogSource.h"

namespace akimap::app {

namespace {

using Sources = std::vector<std::unique_ptr<ScanSource>>;

/** \exception std::runtime_error if the given trajectory has no pose for any scan of any rawlog */
void requireCoverage(const InputRequest& request, const RobotPath& path, const Sources& sources) {
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

Sources openSources(const InputRequest& request) {
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

}  // namespace

void addInputOptions(CLI::App& command, InputRequest& request) {
    command
        .add_option("INPUT", request.inputs,
                    ".rawlog, .simplemap or .pcd files (points in the map frame), taken in turn")
        ->default_str("")
        ->required();
    const auto add = [&](const char* flag, auto& value, const char* help) {
        return command.add_option(flag, value, help)->group(kInputGroup);
    };
    add("--trajectory", request.trajectory,
        "TUM file of the robot's poses in the map, for the rawlogs [default: their own poses, "
        "else odometry]");
    add("--max-gap", request.max_gap, "[s] > 0. Largest gap bridged between robot poses");
    add("--only", request.only_label, "Take only observations with this sensor label")
        ->type_name("LABEL");
    add("--first", request.first, "Take only the first so many scans; 0: all")->check(kWholeNumber);
    command
        .add_flag("--partial", request.partial,
                  "Of a rawlog cut in its last object, take what is whole")
        ->group(kInputGroup);
}

CLI::Option* addFollowOptions(CLI::App& command, InputRequest& request) {
    auto* follow = command.add_flag("--follow", request.follow,
                                    "The last INPUT is a rawlog that is still being written: map "
                                    "it as it grows, until --idle or ^C, then write the map");
    follow->group(kInputGroup);
    command
        .add_option("--idle", request.idle,
                    "[s] > 0. A followed rawlog ends when it has not grown so long")
        ->group(kInputGroup)
        ->needs(follow);
    return follow;
}

void checkInputOptions(const InputRequest& request) {
    if (!(std::isfinite(request.max_gap) && request.max_gap > 0))
        throw std::runtime_error("--max-gap must be finite and > 0");
    if (!(std::isfinite(request.idle) && request.idle > 0))
        throw std::runtime_error("--idle must be finite and > 0");
}

ScanFeed::ScanFeed(const InputRequest& request) : request_(request) {
    if (request.follow) stop_.emplace();
    sources_ = openSources(request);
}

void ScanFeed::forEachScan(const TakeScan& take, bool show_progress) {
    const uint64_t wanted = request_.first ? request_.first : std::numeric_limits<uint64_t>::max();
    uint64_t total = 0, done = 0;
    for (const auto& source : sources_) total += source->scanCount();
    if (request_.follow) total = ProgressBar::kUnknown;
    ProgressBar bar(std::min(total, wanted), show_progress);
    const auto next = [&](Scan& scan) {
        take(scan, done);
        bar.show(++done);
        return done < wanted;
    };
    for (const auto& source : sources_) {
        if (done == wanted) break;
        try {
            source->forEachScan(next, skipped_);
        } catch (const std::exception& e) {
            const std::string what = reasonOf(e.what());
            const bool is_named = what.find(source->file()) != std::string::npos;
            throw std::runtime_error(is_named ? what : source->file() + ": " + what);
        }
    }
    stop_.reset();
}

std::string ScanFeed::wrongLabelHint() const {
    if (skipped_.other_label == 0) return "";
    std::string labels;
    for (const auto& source : sources_)
        for (const std::string& label : source->labels())
            labels += (labels.empty() ? "" : ", ") + label;
    return "--only " + request_.only_label + ", but the sensors are: " + labels;
}

bool insertScan(AkiMap& map, const Scan& scan) {
    if (!scan.observation) return map.insertRays(scan.rays);
    if (!scan.motion) return map.insertObservation(*scan.observation, scan.robot_pose);
    return map.insertMovingObservation(
        *scan.observation, [&](mrpt::Clock::time_point time) { return scan.motion->at(time); });
}

std::vector<Ray> raysOf(const Scan& scan, bool with_free) {
    if (!scan.observation) return scan.rays;
    const auto pose_at = [&](mrpt::Clock::time_point time) {
        return scan.motion ? scan.motion->at(time) : std::optional(scan.robot_pose);
    };
    return akimap::raysOf(*scan.observation, pose_at, scan.motion != nullptr, with_free)
        .value_or(std::vector<Ray>());
}

}  // namespace akimap::app
