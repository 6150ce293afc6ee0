// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "input/FollowSource.h"

#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRobotPose.h>

#include <algorithm>

#include "input/CheckedLog.h"
#include "input/GrowingFile.h"
#include "input/RawlogReader.h"
#include "input/external_files.h"
#include "input/files.h"
#include "input/scan_classes.h"

namespace akimap::app {

using mrpt::obs::CObservation;
using mrpt::obs::CObservationOdometry;
using mrpt::obs::CObservationRobotPose;
using mrpt::poses::CPose3D;
using Time = mrpt::Clock::time_point;

FollowSource::FollowSource(const std::string& file, const InputOptions& options,
                           FollowOptions follow)
    : ScanSource(file),
      options_(options),
      follow_(std::move(follow)),
      max_gap_(RobotPath::toDuration(options.max_gap)),
      idle_(RobotPath::toDuration(follow_.idle)),
      robot_poses_(std::make_shared<RobotPath>(options.max_gap)),
      odometry_(std::make_shared<RobotPath>(options.max_gap)),
      is_chosen_(options.trajectory != nullptr),
      path_(options.trajectory) {
    requireReadable(file);
}

void FollowSource::forEachScan(const TakeScan& take, SkippedScans& skipped) {
    findExternalFiles(file());
    RawlogReader reader(file(),
                        std::make_unique<GrowingFile>(file(), follow_.idle, follow_.is_stopped));
    for (RawlogEntry entry; !follow_.is_stopped() && reader.next(entry);) {
        check(entry);
        notePoses(entry);
        if (entry.observation) noteScan(entry.observation, skipped);
        if (!giveSettled(take, skipped, false)) return;
    }
    if (!reader.cut().empty() && !follow_.is_stopped())
        options_.warn(reader.cut() + ", and did not grow any more; taking what is whole before it");
    giveSettled(take, skipped, true);
}

/** What is still being written can't be read beforehand: MRPT's classes have to be trusted here. */
void FollowSource::check(const RawlogEntry& entry) const {
    if (entry.actions) checkObject(*entry.actions, file(), options_.external_files);
    if (entry.observation) checkObject(*entry.observation, file(), options_.external_files);
}

void FollowSource::notePoses(const RawlogEntry& entry) {
    if (CPose3D increment; entry.actions) {
        if (!entry.actions->getFirstMovementEstimationMean(increment)) return;
        dead_reckoning_ = dead_reckoning_ + increment;
        has_increments_ = true;
        return;
    }
    const CObservation& observation = *entry.observation;
    if (const auto* pose = dynamic_cast<const CObservationRobotPose*>(&observation)) {
        if (is_chosen_ && path_ != robot_poses_ && !options_.trajectory &&
            robot_poses_->samples().empty())
            options_.warn(file() +
                          ": its robot poses begin too late to be followed; akimap build "
                          "without --follow would use them instead of odometry");
        robot_poses_->add(RobotPath::sampleOf(pose->timestamp, pose->pose.mean));
    } else if (const auto* odometry = dynamic_cast<const CObservationOdometry*>(&observation)) {
        odometry_->add(RobotPath::sampleOf(odometry->timestamp, CPose3D(odometry->odometry)));
    } else {
        return;
    }
    newest_pose_ = std::max(newest_pose_, observation.timestamp);
}

void FollowSource::noteScan(const CObservation::Ptr& observation, SkippedScans& skipped) {
    if (isScan(*observation)) labels_.insert(observation->sensorLabel);
    if (!isWantedScan(*observation, options_.only_label, skipped)) return;
    newest_scan_ = std::max(newest_scan_, observation->timestamp);
    waiting_.push_back({observation, dead_reckoning_});
}

/** False if it is too early to say. The order is that of RawlogSource. */
bool FollowSource::choosePoses(Time first_scan, bool at_end) {
    const auto log_time = std::max(newest_scan_, newest_pose_);
    if (!at_end && log_time < first_scan + max_gap_) return false;
    if (!robot_poses_->samples().empty()) {
        path_ = robot_poses_;
    } else if (!has_increments_ && !odometry_->samples().empty()) {
        path_ = odometry_;
    } else if (!has_increments_) {
        if (!at_end && log_time < first_scan + idle_) return false;
        options_.warn(fixedPoseWarning(file()));
    }
    is_chosen_ = true;
    return true;
}

bool FollowSource::isSettled(Time scan) const {
    if (!path_ || options_.trajectory) return true;
    return path_->samples().back().time >= scan + max_gap_ || newest_scan_ >= scan + idle_;
}

/** Gives the scans that need wait no more; false if no more are wanted. */
bool FollowSource::giveSettled(const TakeScan& take, SkippedScans& skipped, bool at_end) {
    while (!waiting_.empty()) {
        const Time time = waiting_.front().observation->timestamp;
        if (!is_chosen_ && !choosePoses(time, at_end)) return true;
        if (!at_end && !isSettled(time)) return true;
        const WaitingScan next = std::move(waiting_.front());
        waiting_.pop_front();
        const auto pose = path_ ? path_->at(time) : std::optional<CPose3D>(next.dead_reckoning);
        if (!pose) {
            skipped.outside_trajectory++;
            continue;
        }
        Scan scan{next.observation, *pose, path_, {}};
        if (!take(scan)) return false;
    }
    return true;
}

}  // namespace akimap::app
