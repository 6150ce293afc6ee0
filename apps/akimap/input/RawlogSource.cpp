// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "input/RawlogSource.h"

#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRobotPose.h>

#include <algorithm>

#include "input/RawlogReader.h"
#include "input/external_files.h"
#include "input/scan_classes.h"

namespace akimap::app {

using mrpt::obs::CObservation;
using mrpt::obs::CObservationOdometry;
using mrpt::obs::CObservationRobotPose;
using mrpt::poses::CPose3D;

/** What the first reading of a log finds; holds no observations. */
struct RawlogSource::Survey {
    std::vector<mrpt::Clock::time_point> scan_times;
    std::vector<RobotPath::Sample> robot_poses, odometry;
    bool has_increments = false;
    std::set<std::string> labels;

    void add(const RawlogEntry& entry, const std::string& only_label) {
        CPose3D increment;
        if (entry.actions) {
            has_increments |= entry.actions->getFirstMovementEstimationMean(increment);
            return;
        }
        const CObservation& observation = *entry.observation;
        if (const auto* pose = dynamic_cast<const CObservationRobotPose*>(&observation))
            robot_poses.push_back(RobotPath::sampleOf(pose->timestamp, pose->pose.mean));
        if (const auto* pose = dynamic_cast<const CObservationOdometry*>(&observation))
            odometry.push_back(RobotPath::sampleOf(pose->timestamp, CPose3D(pose->odometry)));
        if (!isScan(observation)) return;
        labels.insert(observation.sensorLabel);
        if (only_label.empty() || observation.sensorLabel == only_label)
            scan_times.push_back(observation.timestamp);
    }
};

RawlogSource::RawlogSource(const std::string& file, const InputOptions& options)
    : ScanSource(file),
      log_(file, options.external_files),
      only_label_(options.only_label),
      partial_(options.partial) {
    Survey found = survey(options);
    choosePoses(found, options);
    const auto is_covered = [this](auto time) { return !trajectory_ || trajectory_->at(time); };
    scan_count_ = static_cast<std::size_t>(
        std::count_if(found.scan_times.begin(), found.scan_times.end(), is_covered));
    uncovered_count_ = found.scan_times.size() - scan_count_;
    labels_ = std::move(found.labels);
}

RawlogSource::Survey RawlogSource::survey(const InputOptions& options) const {
    Survey found;
    RawlogReader reader(log_, partial_);
    for (RawlogEntry entry; reader.next(entry);) found.add(entry, only_label_);
    if (!reader.cut().empty()) options.warn(reader.cut() + "; taking what is whole before it");
    return found;
}

void RawlogSource::choosePoses(Survey& survey, const InputOptions& options) {
    const auto make = [&](std::vector<RobotPath::Sample>& samples) {
        return std::make_shared<const RobotPath>(std::move(samples), options.max_gap);
    };
    if (options.trajectory)
        trajectory_ = options.trajectory;
    else if (!survey.robot_poses.empty())
        trajectory_ = make(survey.robot_poses);
    else if (survey.has_increments)
        trajectory_ = nullptr;
    else if (!survey.odometry.empty())
        trajectory_ = make(survey.odometry);
    else if (survey.scan_times.size() > 1)
        options.warn(fixedPoseWarning(file()));
}

void RawlogSource::forEachScan(const TakeScan& take, SkippedScans& skipped) {
    findExternalFiles(file());
    RawlogReader reader(log_, partial_);
    CPose3D dead_reckoning;
    for (RawlogEntry entry; reader.next(entry);) {
        if (CPose3D increment; entry.actions) {
            if (entry.actions->getFirstMovementEstimationMean(increment))
                dead_reckoning = dead_reckoning + increment;
            continue;
        }
        if (!isWantedScan(*entry.observation, only_label_, skipped)) continue;
        const auto pose = trajectory_ ? trajectory_->at(entry.observation->timestamp)
                                      : std::optional<CPose3D>(dead_reckoning);
        if (!pose) {
            skipped.outside_trajectory++;
            continue;
        }
        Scan scan{entry.observation, *pose, trajectory_, {}};
        entry = {};  // the observation lives no longer than its scan
        if (!take(scan)) return;
    }
}

}  // namespace akimap::app
