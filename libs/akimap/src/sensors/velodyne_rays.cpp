// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "sensors/velodyne_rays.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>

#include "sensors/SensorFrame.h"

namespace akimap {
namespace {

using mrpt::obs::CObservationVelodyneScan;
using mrpt::poses::CPose3D;

/** Receives decoded Velodyne points; each packet has a time and so a pose of its own. */
class PacketRays : public CObservationVelodyneScan::PointCloudStorageWrapper {
 public:
    PacketRays(const CPose3D& sensor_on_robot, const RobotPoseAt& robot_pose_at,
               std::vector<Ray>& rays)
        : sensor_on_robot_(sensor_on_robot), robot_pose_at_(robot_pose_at), rays_(rays) {}
    /** Points farther away [m] are beams of that length without a return. */
    void endAt(double range) { range_ = range; }
    void add_point(float x, float y, float z, uint8_t /*intensity*/,
                   const mrpt::system::TTimeStamp& time, const float /*azimuth*/,
                   uint16_t /*laser*/) override {
        if (!have_time_ || time != time_) placeAt(time);
        if (!frame_) return;
        const double d = range_ ? std::hypot(x, y, z) : 0;
        const bool hit = !range_ || d <= *range_;
        if (hit)
            rays_.push_back(frame_->rayTo(x, y, z));
        else
            rays_.push_back(
                frame_->rayTo(x * *range_ / d, y * *range_ / d, z * *range_ / d, false));
    }

 private:
    void placeAt(const mrpt::system::TTimeStamp& time) {
        have_time_ = true, time_ = time;
        const auto robot = robot_pose_at_(time);
        if (robot)
            frame_.emplace(*robot + sensor_on_robot_);
        else
            frame_.reset();
    }
    const CPose3D& sensor_on_robot_;
    const RobotPoseAt& robot_pose_at_;
    std::vector<Ray>& rays_;
    std::optional<double> range_;
    bool have_time_ = false;
    mrpt::system::TTimeStamp time_;
    std::optional<SensorFrame> frame_;
};

void decodePackets(const CObservationVelodyneScan& o, PacketRays& receiver) {
    if (o.scan_packets.empty()) return;  // MRPT would clear the cloud
    CObservationVelodyneScan::TGeneratePointCloudParameters all;
    all.minDistance = 0;  // 1 m by default: our own range rule, and the sensor's, decide
    // This overload does not touch the observation, though it is not declared const.
    const_cast<CObservationVelodyneScan&>(o).generatePointCloud(receiver, all);
}

/** Beams without a return have the distance 0, which MRPT does not decode: the largest that can be
 * written takes its place. */
void decodePacketsAndFree(const CObservationVelodyneScan& o, PacketRays& receiver) {
    constexpr double kBelowLargest = 130;  // [m] of 131.07, before the calibration
    CObservationVelodyneScan all = o;
    for (auto& packet : all.scan_packets)
        for (auto& block : packet.blocks)
            for (auto& r : block.laser_returns) {
                uint16_t distance = 0;  // its first two bytes, in either order: MRPT's own function
                std::memcpy(&distance, &r, sizeof distance);  // takes them to be aligned
                if (distance == 0) std::memset(static_cast<void*>(&r), 0xff, sizeof distance);
            }
    receiver.endAt(std::min(o.maxRange, kBelowLargest));
    all.maxRange = 2 * kBelowLargest;
    decodePackets(all, receiver);
}

}  // namespace

void addVelodyne(const CObservationVelodyneScan& o, const RobotPoseAt& robot_pose_at, bool moving,
                 bool with_free, std::vector<Ray>& rays) {
    PacketRays receiver(o.sensorPose, robot_pose_at, rays);
    if (with_free && !o.scan_packets.empty()) return decodePacketsAndFree(o, receiver);
    const auto& cloud = o.point_cloud;
    const bool timed = cloud.timestamp.size() == cloud.x.size();
    // A cloud that MRPT made of the packets usually has no times.
    if (cloud.x.empty() || (moving && !timed && !o.scan_packets.empty()))
        return decodePackets(o, receiver);
    for (std::size_t i = 0; i < cloud.x.size(); i++)
        receiver.add_point(cloud.x[i], cloud.y[i], cloud.z[i], 0,
                           timed ? cloud.timestamp[i] : o.timestamp, 0, 0);
}

}  // namespace akimap
