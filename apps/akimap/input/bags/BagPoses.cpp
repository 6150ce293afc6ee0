// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "input/bags/BagPoses.h"

#include <geometry_msgs/PoseStamped.h>
#include <nav_msgs/Odometry.h>
#include <rosbag/view.h>
#include <sensor_msgs/CameraInfo.h>
#include <tf2_msgs/TFMessage.h>

#include <stdexcept>

#include "input/bags/bag_messages.h"

namespace akimap::app {

namespace {

using mrpt::poses::CPose3D;
using rosbag::MessageInstance;
using Time = mrpt::Clock::time_point;

template <class Translation, class Rotation>
CPose3D toPose(const Translation& t, const Rotation& q) {
    mrpt::math::CQuaternionDouble rotation(q.w, q.x, q.y, q.z);
    if (!(rotation.normSqr() > 0.5)) throw std::runtime_error("a pose without a rotation");
    rotation.normalize();
    return CPose3D(rotation, t.x, t.y, t.z);
}

std::string frameOf(std::string name) {
    if (!name.empty() && name[0] == '/') name.erase(0, 1);  // as tf had them once
    return name;
}

void addTransforms(TransformTree& tree, const tf2_msgs::TFMessage& message) {
    for (const auto& t : message.transforms)
        tree.add(frameOf(t.header.frame_id), frameOf(t.child_frame_id), timeOf(t.header.stamp),
                 toPose(t.transform.translation, t.transform.rotation));
}

template <class Message>
bool is(const MessageInstance& m) {
    return m.getDataType() == ros::message_traits::DataType<Message>::value();
}

bool isDepth(const MessageInstance& m) {
    return is<sensor_msgs::Image>(m) && m.getTopic().find("depth") != std::string::npos;
}

/** Whether each scan has a pose of its own, nearer in time than any other scan's. */
bool areOneEach(const std::vector<geometry_msgs::PoseStamped::ConstPtr>& poses,
                const std::vector<SeenScan>& seen) {
    if (poses.size() != seen.size()) return false;
    for (std::size_t i = 0; i < poses.size(); i++) {
        const auto apart = [&](std::size_t k) {
            const auto d = timeOf(poses[i]->header.stamp) - seen[k].time;
            return d < d.zero() ? -d : d;
        };
        if ((i > 0 && apart(i - 1) <= apart(i)) ||
            (i + 1 < seen.size() && apart(i + 1) <= apart(i)))
            return false;
    }
    return true;
}

}  // namespace

bool isScanMessage(const MessageInstance& m) {
    return is<sensor_msgs::PointCloud2>(m) || is<sensor_msgs::LaserScan>(m) || isDepth(m);
}

SeenScan seenOf(const MessageInstance& m) {
    const auto of = [](const std_msgs::Header& h) {
        return SeenScan{timeOf(h.stamp), frameOf(h.frame_id)};
    };
    if (const auto cloud = m.instantiate<sensor_msgs::PointCloud2>()) return of(cloud->header);
    if (const auto laser = m.instantiate<sensor_msgs::LaserScan>()) return of(laser->header);
    const auto image = m.instantiate<sensor_msgs::Image>();
    if (!image) throw std::runtime_error("a message of " + m.getTopic() + " is damaged");
    return of(image->header);
}

BagPoses::BagPoses(const std::string& file, const InputOptions& options)
    : only_topic_(options.only_label),
      trajectory_(options.trajectory),
      extrinsic_(options.extrinsic),
      tree_(options.max_gap) {
    survey(file);
}

void BagPoses::survey(const std::string& file) {
    rosbag::Bag bag(file, rosbag::bagmode::Read);
    rosbag::View view(bag);
    std::vector<MessageInstance> odometry, poses;
    std::vector<SeenScan> seen;
    for (const MessageInstance& m : view) {
        if (const auto tf = m.instantiate<tf2_msgs::TFMessage>()) {
            addTransforms(tree_, *tf);
        } else if (is<nav_msgs::Odometry>(m)) {
            odometry.push_back(m);
        } else if (is<geometry_msgs::PoseStamped>(m)) {
            poses.push_back(m);
        } else if (const auto info = m.instantiate<sensor_msgs::CameraInfo>()) {
            cameras_[frameOf(info->header.frame_id)] = {info->K[0], info->K[4], info->K[2],
                                                        info->K[5]};
        } else if (isScanMessage(m)) {
            topics_.insert(m.getTopic());
            if (only_topic_.empty() || m.getTopic() == only_topic_) seen.push_back(seenOf(m));
        }
    }
    if (!tree_.anyMoves()) addOdometry(odometry);
    if (!tree_.anyMoves()) addPoses(poses, seen);
    chooseBody(seen);
    for (const SeenScan& scan : seen) bodyAt(scan.frame, scan.time) ? covered_++ : uncovered_++;
    if (trajectory_)
        how_ = "by --poses";
    else if (how_.empty() && tree_.anyMoves())
        how_ = "by tf";
}

void BagPoses::addOdometry(const std::vector<MessageInstance>& messages) {
    for (const MessageInstance& m : messages) {
        const auto o = m.instantiate<nav_msgs::Odometry>();
        const std::string child = frameOf(o->child_frame_id);
        tree_.add(frameOf(o->header.frame_id), child.empty() ? m.getTopic() : child,
                  timeOf(o->header.stamp), toPose(o->pose.pose.position, o->pose.pose.orientation));
        how_ = "by the odometry of " + m.getTopic();
    }
}

void BagPoses::addPoses(const std::vector<MessageInstance>& messages,
                        const std::vector<SeenScan>& seen) {
    std::vector<geometry_msgs::PoseStamped::ConstPtr> poses;
    for (const MessageInstance& m : messages)
        poses.push_back(m.instantiate<geometry_msgs::PoseStamped>());
    const bool paired = areOneEach(poses, seen);
    for (std::size_t i = 0; i < poses.size(); i++)
        tree_.add(frameOf(poses[i]->header.frame_id), messages[i].getTopic(),
                  paired ? seen[i].time : timeOf(poses[i]->header.stamp),
                  toPose(poses[i]->pose.position, poses[i]->pose.orientation));
    if (!poses.empty())
        how_ = "by the poses of " + messages[0].getTopic() + (paired ? ", one each scan" : "");
}

void BagPoses::chooseBody(const std::vector<SeenScan>& seen) {
    for (const SeenScan& scan : seen) {
        if (!tree_.movingAbove(scan.frame).empty() || !body_.empty()) continue;
        const auto moving = tree_.movingBelow(isMap(scan.frame) ? scan.frame : "");
        if (moving.size() > 1 && !trajectory_)
            throw std::runtime_error("its scans are in the frame " + scan.frame +
                                     ", and which of the frames " + moving[0] + ", " + moving[1] +
                                     ", ... was their sensor is not said; --poses "
                                     "FILE tells where it was");
        if (!moving.empty()) body_ = moving.front();
    }
}

bool BagPoses::isMap(const std::string& frame) const {
    return !trajectory_ && tree_.movingAbove(frame).empty() && !tree_.movingBelow(frame).empty();
}

bool BagPoses::moves(const std::string& frame) const {
    return trajectory_ || !tree_.movingAbove(frame).empty() || !body_.empty();
}

std::optional<CPose3D> BagPoses::bodyAt(const std::string& frame, Time time) const {
    if (trajectory_) return trajectory_->at(time);
    const std::string moving = tree_.movingAbove(frame);
    if (!moving.empty()) return tree_.at(moving, time);
    if (!body_.empty()) return tree_.at(body_, time);
    return CPose3D();
}

CPose3D BagPoses::sensorOnBody(const std::string& frame) const {
    const bool is_given = extrinsic_ != CPose3D();
    return is_given || isMap(frame) ? extrinsic_ : tree_.inBody(frame);
}

Cloud BagPoses::inMap(Cloud cloud, const std::string& frame) const {
    const CPose3D place = tree_.inBody(frame);  // it does not move in the map
    for (auto& [x, y, z] : cloud.points) place.composePoint(x, y, z, x, y, z);
    return cloud;
}

}  // namespace akimap::app
