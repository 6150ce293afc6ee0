// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "input/bags/TransformTree.h"

#include <algorithm>

namespace akimap::app {

namespace {

constexpr int kDeepest = 100;  // links above a frame; damaged trees may run in circles

bool isFirst(const RobotPath& path, const RobotPath::Sample& sample) {
    const auto& a = path.samples().front().pose;
    const auto& b = sample.pose;
    return a.x == b.x && a.y == b.y && a.z == b.z && a.qr == b.qr && a.qx == b.qx && a.qy == b.qy &&
           a.qz == b.qz;
}

}  // namespace

void TransformTree::add(const std::string& parent, const std::string& child, Time time,
                        const Pose& pose) {
    Link& link = links_.try_emplace(child, Link{parent, RobotPath(max_gap_), false}).first->second;
    const auto sample = RobotPath::sampleOf(time, pose);
    link.parent = parent;
    link.path.add(sample);
    link.moves = link.moves || !isFirst(link.path, sample);
}

const TransformTree::Link* TransformTree::linkOf(const std::string& frame) const {
    const auto link = links_.find(frame);
    return link == links_.end() ? nullptr : &link->second;
}

bool TransformTree::isParent(const std::string& frame) const {
    return std::any_of(links_.begin(), links_.end(),
                       [&](const auto& link) { return link.second.parent == frame; });
}

bool TransformTree::anyMoves() const {
    return std::any_of(links_.begin(), links_.end(),
                       [](const auto& link) { return link.second.moves; });
}

std::string TransformTree::movingAbove(const std::string& frame) const {
    std::string at = frame;
    for (int i = 0; i < kDeepest; i++) {
        const Link* link = linkOf(at);
        if (!link) return "";
        if (link->moves) return at;
        at = link->parent;
    }
    return "";
}

std::vector<std::string> TransformTree::movingBelow(const std::string& frame) const {
    std::vector<std::string> found;
    for (const auto& entry : links_) {
        if (isParent(entry.first)) continue;
        std::string at = entry.first;
        bool moves = false;
        for (int i = 0; i < kDeepest && at != frame && linkOf(at); i++) {
            moves = moves || linkOf(at)->moves;
            at = linkOf(at)->parent;
        }
        if (moves && (frame.empty() || at == frame)) found.push_back(entry.first);
    }
    return found;
}

std::optional<TransformTree::Pose> TransformTree::at(const std::string& frame, Time time) const {
    Pose pose;
    std::string name = frame;
    for (int i = 0; i < kDeepest; i++) {
        const Link* link = linkOf(name);
        if (!link) return pose;
        const auto in_parent = link->moves
                                   ? link->path.at(time)
                                   : std::optional(RobotPath::poseOf(link->path.samples().front()));
        if (!in_parent) return std::nullopt;
        pose = *in_parent + pose;
        name = link->parent;
    }
    return std::nullopt;
}

TransformTree::Pose TransformTree::inBody(const std::string& frame) const {
    Pose pose;
    std::string name = frame;
    for (int i = 0; i < kDeepest; i++) {
        const Link* link = linkOf(name);
        if (!link || link->moves) break;
        pose = RobotPath::poseOf(link->path.samples().front()) + pose;
        name = link->parent;
    }
    return pose;
}

}  // namespace akimap::app
