// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <map>
#include <optional>
#include <string>

#include "input/poses/RobotPath.h"

namespace akimap::app {

/** The frames of a bag, each placed in its parent over time: what tf tells. */
class TransformTree {
 public:
    using Pose = mrpt::poses::CPose3D;
    using Time = mrpt::Clock::time_point;

    /** \param max_gap [s] larger gaps between poses are not bridged */
    explicit TransformTree(double max_gap) : max_gap_(max_gap) {}

    void add(const std::string& parent, const std::string& child, Time time, const Pose& pose);

    /** Whether any frame moves in its parent. */
    [[nodiscard]] bool anyMoves() const;
    /** The frame, or the nearest above it, that moves in its parent; empty if none does. */
    [[nodiscard]] std::string movingAbove(const std::string& frame) const;
    /** The frames that move, below one (empty: any), and have none below themselves. */
    [[nodiscard]] std::vector<std::string> movingBelow(const std::string& frame) const;

    /** The pose of a frame in the root of its tree; empty where a link has no pose at that time. */
    [[nodiscard]] std::optional<Pose> at(const std::string& frame, Time time) const;
    /** Its pose in the farthest frame above it that it does not move in. */
    [[nodiscard]] Pose inBody(const std::string& frame) const;

 private:
    [[nodiscard]] bool isParent(const std::string& frame) const;
    struct Link {
        std::string parent;
        RobotPath path;
        bool moves = false;
    };
    [[nodiscard]] const Link* linkOf(const std::string& frame) const;

    double max_gap_;
    std::map<std::string, Link> links_;  // by child
};

}  // namespace akimap::app
