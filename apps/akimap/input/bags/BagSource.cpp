// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "input/bags/BagSource.h"

#include <geometry_msgs/PoseStamped.h>
#include <nav_msgs/Odometry.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/CameraInfo.h>
#include <tf2_msgs/TFMessage.h>

#include <algorithm>
#include <stdexcept>

#include "input/bags/TransformTree.h"
#include "input/bags/bag_messages.h"
#include "input/clouds/place_cloud.h"
#include "input/files.h"

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

template <class Message>
bool is(const MessageInstance& m) {
    return m.getDataType() == ros::message_traits::DataType<Message>::value();
}

bool isDepth(const MessageInstance& m) {
    return is<sensor_msgs::Image>(m) && m.getTopic().find("depth") != std::string::npos;
}

bool isScanMessage(const MessageInstance& m) {
    return is<sensor_msgs::PointCloud2>(m) || is<sensor_msgs::LaserScan>(m) || isDepth(m);
}

class BagSource : public ScanSource {
 public:
    BagSource(const std::string& file, const InputOptions& options)
        : ScanSource(file), options_(options), tree_(options.max_gap) {
        requireReadable(file);
        try {
            survey();
        } catch (const std::exception& e) {
            throw std::runtime_error(file + ": no ROS 1 bag, or damaged: " + e.what());
        }
        warnOfPoses();
    }

    [[nodiscard]] std::size_t scanCount() const override { return scan_count_; }
    [[nodiscard]] std::optional<std::size_t> uncoveredCount() const override {
        return uncovered_count_;
    }
    [[nodiscard]] std::set<std::string> labels() const override { return topics_; }
    [[nodiscard]] std::string how() const override { return how_; }

    void forEachScan(const TakeScan& take, SkippedScans& skipped) override {
        rosbag::Bag bag(file(), rosbag::bagmode::Read);
        rosbag::View view(bag);
        for (const MessageInstance& m : view) {
            if (!isScanMessage(m)) continue;
            if (!options_.only_label.empty() && m.getTopic() != options_.only_label) {
                skipped.other_label++;
                continue;
            }
            std::optional<Scan> scan = scanOf(m, skipped);
            if (!scan)
                skipped.outside_trajectory++;
            else if (!take(*scan))
                return;
        }
    }

 private:
    struct Seen {
        Time time;
        std::string frame;
    };

    /** Gathers the poses and when the scans were taken. */
    void survey() {
        rosbag::Bag bag(file(), rosbag::bagmode::Read);
        rosbag::View view(bag);
        std::vector<MessageInstance> odometry, poses;
        std::vector<Seen> seen;
        for (const MessageInstance& m : view) {
            if (const auto tf = m.instantiate<tf2_msgs::TFMessage>()) {
                for (const auto& t : tf->transforms)
                    tree_.add(frameOf(t.header.frame_id), frameOf(t.child_frame_id),
                              timeOf(t.header.stamp),
                              toPose(t.transform.translation, t.transform.rotation));
            } else if (is<nav_msgs::Odometry>(m)) {
                odometry.push_back(m);
            } else if (is<geometry_msgs::PoseStamped>(m)) {
                poses.push_back(m);
            } else if (const auto info = m.instantiate<sensor_msgs::CameraInfo>()) {
                cameras_[frameOf(info->header.frame_id)] = {info->K[0], info->K[4], info->K[2],
                                                            info->K[5]};
            } else if (isScanMessage(m)) {
                topics_.insert(m.getTopic());
                if (options_.only_label.empty() || m.getTopic() == options_.only_label)
                    seen.push_back(seenOf(m));
            }
        }
        if (!tree_.anyMoves()) addOdometry(odometry);
        if (!tree_.anyMoves()) addPoses(poses, seen);
        chooseBody(seen);
        for (const Seen& scan : seen)
            bodyAt(scan.frame, scan.time) ? scan_count_++ : uncovered_count_++;
    }

    static Seen seenOf(const MessageInstance& m) {
        const auto of = [](const std_msgs::Header& h) {
            return Seen{timeOf(h.stamp), frameOf(h.frame_id)};
        };
        if (const auto cloud = m.instantiate<sensor_msgs::PointCloud2>()) return of(cloud->header);
        if (const auto laser = m.instantiate<sensor_msgs::LaserScan>()) return of(laser->header);
        const auto image = m.instantiate<sensor_msgs::Image>();
        if (!image) throw std::runtime_error("a message of " + m.getTopic() + " is damaged");
        return of(image->header);
    }

    void addOdometry(const std::vector<MessageInstance>& messages) {
        for (const MessageInstance& m : messages) {
            const auto o = m.instantiate<nav_msgs::Odometry>();
            const std::string child = frameOf(o->child_frame_id);
            tree_.add(frameOf(o->header.frame_id), child.empty() ? m.getTopic() : child,
                      timeOf(o->header.stamp),
                      toPose(o->pose.pose.position, o->pose.pose.orientation));
            how_ = "by the odometry of " + m.getTopic();
        }
    }

    void addPoses(const std::vector<MessageInstance>& messages, const std::vector<Seen>& seen) {
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

    /** Whether each scan has a pose of its own, nearer in time than any other scan's. */
    static bool areOneEach(const std::vector<geometry_msgs::PoseStamped::ConstPtr>& poses,
                           const std::vector<Seen>& seen) {
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

    /** What carries the sensors whose own frames tf does not place. */
    void chooseBody(const std::vector<Seen>& seen) {
        for (const Seen& scan : seen) {
            if (!tree_.movingAbove(scan.frame).empty() || !body_.empty()) continue;
            const auto moving = tree_.movingBelow(isMap(scan.frame) ? scan.frame : "");
            if (moving.size() > 1 && !options_.trajectory)
                throw std::runtime_error("its scans are in the frame " + scan.frame +
                                         ", and which of the frames " + moving[0] + ", " +
                                         moving[1] +
                                         ", ... was their sensor is not said; --poses "
                                         "FILE tells where it was");
            if (!moving.empty()) body_ = moving.front();
        }
    }

    /** Whether scans in this frame are in the map already: their sensor moves in it. */
    [[nodiscard]] bool isMap(const std::string& frame) const {
        return tree_.movingAbove(frame).empty() && !tree_.movingBelow(frame).empty();
    }

    /** The pose of what the scan's sensor is on. */
    [[nodiscard]] std::optional<CPose3D> bodyAt(const std::string& frame, Time time) const {
        if (options_.trajectory) return options_.trajectory->at(time);
        const std::string moving = tree_.movingAbove(frame);
        if (!moving.empty()) return tree_.at(moving, time);
        if (!body_.empty()) return tree_.at(body_, time);
        return CPose3D();
    }

    [[nodiscard]] CPose3D sensorOnBody(const std::string& frame) const {
        return options_.extrinsic == CPose3D() ? tree_.inBody(frame) : options_.extrinsic;
    }

    void warnOfPoses() {
        if (topics_.size() > 1 && options_.only_label.empty()) {
            std::string names;
            for (const std::string& topic : topics_) names += (names.empty() ? "" : ", ") + topic;
            options_.warn(file() + ": scans of all topics are taken, " + names +
                          "; --only TOPIC takes one");
        }
        if (options_.trajectory)
            how_ = "by --poses";
        else if (how_.empty() && tree_.anyMoves())
            how_ = "by tf";
        else if (how_.empty() && scan_count_ > 1)
            options_.warn(file() +
                          ": no tf, odometry or poses in it, and no --poses: all its scans are "
                          "taken from one fixed pose");
    }

    /** Empty where there is no pose. */
    std::optional<Scan> scanOf(const MessageInstance& m, SkippedScans& skipped) const {
        const Seen seen = seenOf(m);
        const auto body = bodyAt(seen.frame, seen.time);
        if (!body) return std::nullopt;
        Scan scan;
        scan.robot_pose = *body;
        scan.time = seen.time;
        const CPose3D on_body = sensorOnBody(seen.frame);
        if (const auto cloud = m.instantiate<sensor_msgs::PointCloud2>()) {
            scan.sensor_pose = isMap(seen.frame) ? options_.extrinsic : on_body;
            placeCloud(scan, cloudOf(*cloud), seen, skipped);
        } else if (const auto laser = m.instantiate<sensor_msgs::LaserScan>()) {
            setObservation(scan, laserOf(*laser), on_body, m.getTopic());
        } else {
            const auto camera = cameras_.find(seen.frame);
            if (camera == cameras_.end())
                throw std::runtime_error(m.getTopic() + ": no camera_info for its frame " +
                                         seen.frame);
            const auto image = m.instantiate<sensor_msgs::Image>();
            setObservation(scan, depthOf(*image, camera->second), on_body, m.getTopic());
        }
        return scan;
    }

    template <class Observation>
    static void setObservation(Scan& scan, const std::shared_ptr<Observation>& observation,
                               const CPose3D& on_body, const std::string& topic) {
        observation->sensorPose = on_body + observation->sensorPose;
        observation->sensorLabel = topic;
        scan.observation = observation;
    }

    [[nodiscard]] Cloud inMap(Cloud cloud, const std::string& frame) const {
        const CPose3D place = tree_.inBody(frame);  // it does not move in the map
        for (auto& [x, y, z] : cloud.points) place.composePoint(x, y, z, x, y, z);
        return cloud;
    }

    void placeCloud(Scan& scan, const Cloud& cloud, const Seen& seen, SkippedScans& skipped) const {
        const bool moves = options_.trajectory || !tree_.movingAbove(seen.frame).empty();
        if (isMap(seen.frame) && !options_.trajectory)
            return placeBare(scan, inMap(cloud, seen.frame), CloudFrame::map);
        if (!options_.deskew || cloud.time.empty() || !moves)
            return placeBare(scan, cloud, CloudFrame::sensor);
        const auto sensor_at = [&](Time time) {
            auto pose = bodyAt(seen.frame, time);
            if (pose) pose = *pose + scan.sensor_pose;
            return pose;
        };
        placeMoving(scan, cloud, sensor_at, skipped);
    }

    InputOptions options_;
    TransformTree tree_;
    std::map<std::string, Intrinsics> cameras_;  // by frame
    std::set<std::string> topics_;               // of scans
    std::string body_, how_;
    std::size_t scan_count_ = 0, uncovered_count_ = 0;
};

}  // namespace

std::unique_ptr<ScanSource> openBag(const std::string& file, const InputOptions& options) {
    return std::make_unique<BagSource>(file, options);
}

std::string bagReaderName() {
    return "by librosbag_storage";
}

}  // namespace akimap::app
