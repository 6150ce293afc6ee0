// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <mrpt/core/Clock.h>
#include <mrpt/math/TPose3DQuat.h>
#include <mrpt/poses/CPose3D.h>

#include <optional>
#include <string>
#include <vector>

#include "input/poses/pose_file.h"

namespace akimap::app {

/** The robot's pose in the map over time: linear between samples, its rotation by slerp. */
class RobotPath {
 public:
    struct Sample {
        mrpt::Clock::time_point time;
        mrpt::math::TPose3DQuat pose;  ///< [m], unit quaternion
    };

    /** \param samples in any order; of those at one time the last is kept
     * \param max_gap [s] samples farther apart are not interpolated between */
    RobotPath(std::vector<Sample> samples, double max_gap);

    /** An empty one, to add() to. */
    explicit RobotPath(double max_gap) : RobotPath({}, max_gap) {}
    /** Adds a sample, fast if it belongs to the end; one at the same time is replaced. */
    void add(const Sample& sample);

    [[nodiscard]] static Sample sampleOf(mrpt::Clock::time_point time,
                                         const mrpt::poses::CPose3D& pose);
    [[nodiscard]] static mrpt::poses::CPose3D poseOf(const Sample& sample);
    /** max_gap as at() takes it: a microsecond longer, so that samples written every max_gap
     * seconds count as near enough. */
    [[nodiscard]] static mrpt::Clock::duration toDuration(double max_gap);

    /** \exception std::runtime_error naming the file if its poses have no times */
    [[nodiscard]] static RobotPath of(const PoseList& list, double max_gap);
    /** Of a TUM file, as readPoses() reads it.
     * \exception std::runtime_error naming the file and the line */
    static RobotPath loadTum(const std::string& file, double max_gap);

    /** The pose at that time; empty before the first sample, after the last, and within a gap.
     * A sample stands in for times up to 1 ms away: many files hold no finer times. */
    [[nodiscard]] std::optional<mrpt::poses::CPose3D> at(mrpt::Clock::time_point time) const;

    [[nodiscard]] const std::vector<Sample>& samples() const { return samples_; }  ///< by time

 private:
    std::vector<Sample> samples_;
    mrpt::Clock::duration max_gap_;
};

}  // namespace akimap::app
