// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <deque>

#include "input/ScanSource.h"

namespace akimap::app {

struct RawlogEntry;

/** When a rawlog that is followed is at its end. */
struct FollowOptions {
    double idle = 10;                  ///< [s] > 0. Once it has not grown for so long,
    std::function<bool()> is_stopped;  ///< or this is true; asked often
};

/** The scans of a rawlog that is still being written: the same, with the same poses, in the same
 * order as those of the finished log's RawlogSource, as long as what decides comes in time.
 *
 * A scan waits until the log has a robot pose InputOptions::max_gap after it, so that poses that
 * come late, and those of a Velodyne's later packets, are there; it waits no longer than the log
 * takes to go on for FollowOptions::idle. Where poses come from is settled so at the first scan.
 * A scan behind one that waits waits too: a map depends on their order. */
class FollowSource : public ScanSource {
 public:
    /** \exception std::runtime_error naming the file if it can't be read */
    FollowSource(const std::string& file, const InputOptions& options, FollowOptions follow);

    [[nodiscard]] std::size_t scanCount() const override { return 0; }  ///< not known
    [[nodiscard]] std::set<std::string> labels() const override { return labels_; }
    /** Waits for what is not yet written. */
    void forEachScan(const TakeScan& take, SkippedScans& skipped) override;

 private:
    struct WaitingScan {
        mrpt::obs::CObservation::Ptr observation;
        mrpt::poses::CPose3D dead_reckoning;  // where the actions before it lead
    };

    void check(const RawlogEntry& entry) const;
    void notePoses(const RawlogEntry& entry);
    void noteScan(const mrpt::obs::CObservation::Ptr& observation, SkippedScans& skipped);
    bool choosePoses(mrpt::Clock::time_point first_scan, bool at_end);
    [[nodiscard]] bool isSettled(mrpt::Clock::time_point scan) const;
    bool giveSettled(const TakeScan& take, SkippedScans& skipped, bool at_end);

    InputOptions options_;
    FollowOptions follow_;
    mrpt::Clock::duration max_gap_, idle_;
    std::set<std::string> labels_;

    std::shared_ptr<RobotPath> robot_poses_, odometry_;  // of the log itself, so far
    bool has_increments_ = false;
    mrpt::poses::CPose3D dead_reckoning_;
    bool is_chosen_ = false;                 // where poses come from:
    std::shared_ptr<const RobotPath> path_;  // null: from the actions

    std::deque<WaitingScan> waiting_;
    mrpt::Clock::time_point newest_scan_{}, newest_pose_{};
};

}  // namespace akimap::app
