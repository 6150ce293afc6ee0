// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include "input/CheckedLog.h"
#include "input/ScanSource.h"

namespace akimap::app {

/** The scans of a rawlog. The robot's poses are those of InputOptions::trajectory, else the
 * log's own CObservationRobotPose, else its odometry (increments in its actions, else
 * CObservationOdometry), else all zero with a warning. */
class RawlogSource : public ScanSource {
 public:
    /** Reads the log through.
     * \exception std::runtime_error naming the file: missing, damaged, cut, or no rawlog */
    RawlogSource(const std::string& file, const InputOptions& options);

    [[nodiscard]] std::size_t scanCount() const override { return scan_count_; }
    [[nodiscard]] std::optional<std::size_t> uncoveredCount() const override {
        return uncovered_count_;
    }
    [[nodiscard]] std::set<std::string> labels() const override { return labels_; }
    void forEachScan(const TakeScan& take, SkippedScans& skipped) override;

 private:
    struct Survey;
    Survey survey(const InputOptions& options) const;
    void choosePoses(Survey& survey, const InputOptions& options);

    CheckedLog log_;
    std::string only_label_;
    bool partial_;
    std::shared_ptr<const RobotPath> trajectory_;  // null: increments in the actions, if any
    std::size_t scan_count_ = 0, uncovered_count_ = 0;
    std::set<std::string> labels_;
};

}  // namespace akimap::app
