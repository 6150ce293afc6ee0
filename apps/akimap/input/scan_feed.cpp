// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "input/scan_feed.h"

#include <akimap/rays.h>
#include <mrpt/core/Clock.h>

#include <algorithm>
#include <iostream>
#include <limits>
#include <stdexcept>

#include "errors.h"
#include "input/ProgressBar.h"

namespace akimap::app {

ScanFeed::ScanFeed(const InputRequest& request) : request_(request) {
    if (request.follow) stop_.emplace();
    sources_ = openSources(request, [this](const std::string& line) {
        has_warned_ = true;
        warn(line);
    });
}

void ScanFeed::forEachScan(const TakeScan& take, bool show_progress) {
    const uint64_t wanted = request_.first ? request_.first : std::numeric_limits<uint64_t>::max();
    uint64_t total = 0, done = 0;
    for (const auto& source : sources_) total += source->scanCount();
    if (request_.follow) total = ProgressBar::kUnknown;
    ProgressBar bar(std::min(total, wanted), show_progress);
    const auto next = [&](Scan& scan) {
        notePose(scan);
        take(scan, done);
        bar.show(++done);
        // A followed log's own end comes with what waits in it.
        return done < wanted && (request_.follow || !StopSignal::requested());
    };
    for (const auto& source : sources_) {
        if (done == wanted || (!request_.follow && StopSignal::requested())) break;
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

void ScanFeed::notePose(const Scan& scan) {
    const auto pose = scan.robot_pose;
    if (scans_++ == 0) first_pose_ = pose;
    is_fixed_ = is_fixed_ && pose.asTPose() == first_pose_.asTPose();
}

std::string ScanFeed::wrongLabelHint() const {
    if (skipped_.other_label == 0) return "";
    std::string labels;
    for (const auto& source : sources_)
        for (const std::string& label : source->labels())
            labels += (labels.empty() ? "" : ", ") + label;
    return "--only " + request_.only_label + ", but the sensors are: " + labels;
}

void warn(const std::string& line) {
    std::cerr << "akimap: warning: " << line << "\n";
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
