// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "input/poses/RobotPath.h"

#include <mrpt/math/slerp.h>
#include <mrpt/poses/CPose3DQuat.h>

#include <algorithm>
#include <stdexcept>

namespace akimap::app {

namespace {

using mrpt::math::CQuaternionDouble;
using mrpt::math::TPose3DQuat;
using mrpt::poses::CPose3D;
using Time = mrpt::Clock::time_point;
using Sample = RobotPath::Sample;

constexpr auto kTimeTolerance = std::chrono::milliseconds(1);

CQuaternionDouble rotationOf(const TPose3DQuat& p) {
    return {p.qr, p.qx, p.qy, p.qz};
}

CPose3D toPose(const TPose3DQuat& p) {
    return CPose3D(rotationOf(p), p.x, p.y, p.z);
}

CPose3D between(const Sample& a, const Sample& b, Time time) {
    const double t = static_cast<double>((time - a.time).count()) /
                     static_cast<double>((b.time - a.time).count());
    CQuaternionDouble q;
    mrpt::math::slerp(rotationOf(a.pose), rotationOf(b.pose), t, q);
    q.normalize();
    const auto linear = [t](double from, double to) { return from + t * (to - from); };
    return CPose3D(q, linear(a.pose.x, b.pose.x), linear(a.pose.y, b.pose.y),
                   linear(a.pose.z, b.pose.z));
}

}  // namespace

RobotPath::RobotPath(std::vector<Sample> samples, double max_gap)
    : samples_(std::move(samples)), max_gap_(toDuration(max_gap)) {
    std::stable_sort(samples_.begin(), samples_.end(),
                     [](const Sample& a, const Sample& b) { return a.time < b.time; });
    const auto same_time = [](const Sample& a, const Sample& b) { return a.time == b.time; };
    const auto first_kept = std::unique(samples_.rbegin(), samples_.rend(), same_time).base();
    samples_.erase(samples_.begin(), first_kept);
}

void RobotPath::add(const Sample& sample) {
    const auto behind = std::upper_bound(samples_.begin(), samples_.end(), sample.time,
                                         [](Time time, const Sample& s) { return time < s.time; });
    if (behind != samples_.begin() && std::prev(behind)->time == sample.time)
        *std::prev(behind) = sample;
    else
        samples_.insert(behind, sample);
}

Sample RobotPath::sampleOf(Time time, const CPose3D& pose) {
    return {time, mrpt::poses::CPose3DQuat(pose).asTPose()};
}

CPose3D RobotPath::poseOf(const Sample& sample) {
    return toPose(sample.pose);
}

mrpt::Clock::duration RobotPath::toDuration(double max_gap) {
    constexpr double a_century = 3.2e9;
    return std::chrono::duration_cast<mrpt::Clock::duration>(
        std::chrono::duration<double>(std::min(max_gap, a_century) + 1e-6));
}

RobotPath RobotPath::of(const PoseList& list, double max_gap) {
    if (list.times.empty())
        throw std::runtime_error(list.file + ": " + list.form +
                                 " have no times, which the scans of a log need: a TUM trajectory "
                                 "(time x y z qx qy qz qw) has");
    std::vector<Sample> samples;
    for (std::size_t i = 0; i < list.poses.size(); i++)
        samples.push_back(sampleOf(mrpt::Clock::fromDouble(list.times[i]), list.poses[i]));
    return RobotPath(std::move(samples), max_gap);
}

RobotPath RobotPath::loadTum(const std::string& file, double max_gap) {
    return of(readPoses(file), max_gap);
}

std::optional<CPose3D> RobotPath::at(Time time) const {
    const auto after =
        std::lower_bound(samples_.begin(), samples_.end(), time,
                         [](const Sample& sample, Time t) { return sample.time < t; });
    const bool has_after = after != samples_.end(), has_before = after != samples_.begin();
    if (has_after && after->time == time) return toPose(after->pose);
    if (has_after && has_before && after->time - std::prev(after)->time <= max_gap_)
        return between(*std::prev(after), *after, time);
    if (has_after && after->time - time <= kTimeTolerance) return toPose(after->pose);
    if (has_before && time - std::prev(after)->time <= kTimeTolerance)
        return toPose(std::prev(after)->pose);
    return std::nullopt;
}

}  // namespace akimap::app
