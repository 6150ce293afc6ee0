// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <rosbag/bag.h>
#include <rosbag/message_instance.h>

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "input/ScanSource.h"
#include "input/bags/TransformTree.h"
#include "input/clouds/Cloud.h"
#include "input/depth/intrinsics.h"

namespace akimap::app {

/** When a scan of a bag was taken, and in which frame it is. */
struct SeenScan {
    mrpt::Clock::time_point time;
    std::string frame;
};

/** PointCloud2, LaserScan, or Image of a topic that has "depth" in its name. */
[[nodiscard]] bool isScanMessage(const rosbag::MessageInstance& message);

/** Of such a message. \exception std::runtime_error if it is damaged */
[[nodiscard]] SeenScan seenOf(const rosbag::MessageInstance& message);

/** Where the scans of a bag were taken: by InputOptions::trajectory, else tf, else odometry, else
 * the poses (PoseStamped) of a topic. */
class BagPoses {
 public:
    /** Reads the bag through. \exception std::exception saying what is wrong with it */
    BagPoses(const std::string& file, const InputOptions& options);

    /** Whether scans in this frame are in the map already: their sensor moves in it. */
    [[nodiscard]] bool isMap(const std::string& frame) const;
    /** Whether the sensor of scans in this frame moves. */
    [[nodiscard]] bool moves(const std::string& frame) const;
    /** The pose of what the scan's sensor is on; empty where it is not known. */
    [[nodiscard]] std::optional<mrpt::poses::CPose3D> bodyAt(const std::string& frame,
                                                             mrpt::Clock::time_point time) const;
    [[nodiscard]] mrpt::poses::CPose3D sensorOnBody(const std::string& frame) const;
    /** Puts points in a frame of the map, see isMap(), into the map. */
    [[nodiscard]] Cloud inMap(Cloud cloud, const std::string& frame) const;

    [[nodiscard]] const std::map<std::string, Intrinsics>& cameras() const { return cameras_; }
    [[nodiscard]] const std::set<std::string>& topics() const { return topics_; }  ///< of scans
    [[nodiscard]] const std::string& how() const { return how_; }   ///< empty: no poses
    [[nodiscard]] std::size_t covered() const { return covered_; }  ///< scans with a pose
    [[nodiscard]] std::size_t uncovered() const { return uncovered_; }

 private:
    void survey(const std::string& file);
    void addOdometry(const std::vector<rosbag::MessageInstance>& messages);
    void addPoses(const std::vector<rosbag::MessageInstance>& messages,
                  const std::vector<SeenScan>& seen);
    /** What carries the sensors whose own frames tf does not place. */
    void chooseBody(const std::vector<SeenScan>& seen);

    std::string only_topic_;
    std::shared_ptr<const RobotPath> trajectory_;
    mrpt::poses::CPose3D extrinsic_;
    TransformTree tree_;
    std::map<std::string, Intrinsics> cameras_;  // by frame
    std::set<std::string> topics_;
    std::string body_, how_;
    std::size_t covered_ = 0, uncovered_ = 0;
};

}  // namespace akimap::app
