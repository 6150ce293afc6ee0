// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "input/clouds/CloudSource.h"

#include <mrpt/math/CQuaternion.h>

#include <algorithm>
#include <stdexcept>

#include "input/clouds/place_cloud.h"

namespace akimap::app {

namespace {

using mrpt::poses::CPose3D;

bool isTrivial(const PcdViewpoint& v) {
    return v.translation == std::array<double, 3>{} && !v.isRotated();
}

bool isSame(const std::optional<PcdViewpoint>& a, const std::optional<PcdViewpoint>& b) {
    return a.has_value() == b.has_value() &&
           (!a || (a->translation == b->translation && a->rotation == b->rotation));
}

}  // namespace

CPose3D poseOf(const PcdViewpoint& v) {
    const auto& [w, x, y, z] = v.rotation;
    return CPose3D(mrpt::math::CQuaternionDouble(w, x, y, z), v.translation[0], v.translation[1],
                   v.translation[2]);
}

CloudSource::CloudSource(std::vector<std::string> files, const InputOptions& options)
    : ScanSource(files.front()),
      files_(std::move(files)),
      extrinsic_(options.extrinsic),
      has_poses_(!options.poses.empty()),
      deskew_(options.deskew) {
    for (const std::string& file : files_) viewpoints_.push_back(peekCloud(file));
    chooseFrame(options);
    frames_ = matchPoses(files_, options.poses, options.times, options.max_gap);
}

void CloudSource::chooseFrame(const InputOptions& options) {
    if (!has_poses_) return checkViewpoints(options);
    frame_ = options.frame.value_or(CloudFrame::sensor);
    if (options.frame) return;
    for (std::size_t i = 0; i < files_.size(); i++)
        if (viewpoints_[i] && !isTrivial(*viewpoints_[i]))
            throw std::runtime_error(
                files_[i] +
                ": it has a VIEWPOINT of its own besides --poses; --frame sensor: the poses place "
                "its points; --frame map: its points are in the map frame, and the poses only say "
                "where the sensor stood");
}

void CloudSource::checkViewpoints(const InputOptions& options) {
    frame_ = options.frame.value_or(CloudFrame::map);
    for (std::size_t i = 0; i < files_.size(); i++) {
        if (!viewpoints_[i] && options.frame == CloudFrame::sensor)
            throw std::runtime_error(files_[i] +
                                     ": --frame sensor needs --poses here: the file "
                                     "has no VIEWPOINT");
        if (options.frame) continue;
        if (!viewpoints_[i])
            throw std::runtime_error(
                files_[i] +
                ": where its sensor stood is missing, and decides what is free: it has no "
                "VIEWPOINT; --poses FILE tells, or --frame map if the points are in the map frame "
                "and the sensor stood at 0 0 0");
        if (viewpoints_[i]->isRotated())
            throw std::runtime_error(
                files_[i] +
                ": its VIEWPOINT has a rotation; --frame sensor turns and moves its "
                "points by it, --frame map takes them as they are");
    }
    const auto is_first = [&](const auto& v) { return isSame(v, viewpoints_.front()); };
    if (files_.size() < 2 || !std::all_of(viewpoints_.begin(), viewpoints_.end(), is_first)) return;
    options.warn("all " + std::to_string(files_.size()) + " clouds, " + files_.front() +
                 " and on, have " + (viewpoints_.front() ? "the same" : "no") +
                 " VIEWPOINT: right for a tripod; if the sensor moved, --poses FILE tells where it "
                 "was");
}

std::size_t CloudSource::scanCount() const {
    if (!has_poses_) return files_.size();
    return static_cast<std::size_t>(
        std::count_if(frames_.poses.begin(), frames_.poses.end(),
                      [](const auto& pose) { return pose.has_value(); }));
}

void CloudSource::forEachScan(const TakeScan& take, SkippedScans& skipped) {
    for (std::size_t i = 0; i < files_.size(); i++) {
        if (has_poses_ && !frames_.poses[i]) {
            skipped.outside_trajectory++;
            continue;
        }
        nowReading(files_[i]);
        Scan scan = place(readCloud(files_[i]), i, skipped);
        if (!take(scan)) return;
    }
}

Scan CloudSource::place(const Cloud& cloud, std::size_t i, SkippedScans& skipped) const {
    Scan scan;
    if (has_poses_)
        scan.robot_pose = *frames_.poses[i];
    else if (frame_ == CloudFrame::sensor)
        scan.robot_pose = poseOf(*cloud.viewpoint);
    else if (cloud.viewpoint)
        scan.robot_pose = CPose3D(cloud.viewpoint->translation[0], cloud.viewpoint->translation[1],
                                  cloud.viewpoint->translation[2], 0, 0, 0);
    scan.sensor_pose = extrinsic_;
    if (!frames_.times.empty()) scan.time = frames_.times[i];
    const bool is_timed = deskew_ && frames_.path && scan.time && !cloud.time.empty();
    const auto sensor_at = [&](mrpt::Clock::time_point time) {
        auto pose = frames_.path->at(time);
        if (pose) pose = *pose + extrinsic_;
        return pose;
    };
    if (is_timed && frame_ == CloudFrame::sensor)
        placeMoving(scan, cloud, sensor_at, skipped);
    else
        placeBare(scan, cloud, frame_);
    return scan;
}

}  // namespace akimap::app
