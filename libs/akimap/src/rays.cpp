// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <akimap/rays.h>

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/obs/CObservationRotatingScan.h>
#include <mrpt/obs/CObservationVelodyneScan.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <mutex>

#include "mrpt_compat.h"

namespace akimap {
namespace {

using namespace mrpt::obs;
using mrpt::poses::CPose3D;

/** Appends rays from one sensor pose to points in the sensor's frame. */
class RayMaker {
 public:
    RayMaker(const CPose3D& sensor_in_map, std::vector<Ray>& rays, bool with_free)
        : pose_(sensor_in_map),
          origin_{pose_.x(), pose_.y(), pose_.z()},
          rays_(rays),
          with_free_(with_free) {}
    /** Whether beams without a return are wanted. */
    [[nodiscard]] bool withFree() const { return with_free_; }
    void add(double x, double y, double z, bool hit = true) {
        Ray r{origin_, {}, hit};
        pose_.composePoint(x, y, z, r.end[0], r.end[1], r.end[2]);
        rays_.push_back(r);
    }

 private:
    CPose3D pose_;
    std::array<double, 3> origin_;
    std::vector<Ray>& rays_;
    bool with_free_;
};

/** Depth images are preferred to points3D, which other maps are known to shrink in place. */
void addDepthImage(const CObservation3DRangeScan& o, RayMaker& rays) {
    const auto& image = o.rangeImage;
    const auto& lut = o.get_unproj_lut();
    const auto n = static_cast<std::size_t>(image.size());
    if (lut.Kxs.size() != n)
        throw std::runtime_error("CObservation3DRangeScan '" + o.sensorLabel +
                                 "': range image of " + std::to_string(n) +
                                 " pixels, camera model of " + std::to_string(lut.Kxs.size()));
    const uint16_t* range = image.data();
    for (std::size_t i = 0; i < n; i++) {
        const bool hit = range[i] != 0;
        if (!hit && !rays.withFree()) continue;
        const double d = hit ? range[i] * static_cast<double>(o.rangeUnits) : o.maxRange;
        rays.add(d * lut.Kxs[i], d * lut.Kys[i], d * lut.Kzs[i], hit);
    }
}

template <class Floats>
void addPoints(const Floats& x, const Floats& y, const Floats& z, RayMaker& rays) {
    for (std::size_t i = 0; i < x.size(); i++) rays.add(x[i], y[i], z[i]);
}

void addScan(const CObservation3DRangeScan& o, RayMaker& rays) {
    if (o.hasRangeImage && o.rangeImage.size() > 0)
        addDepthImage(o, rays);
    else if (o.hasPoints3D)
        addPoints(o.points3D_x, o.points3D_y, o.points3D_z, rays);
}

void addScan(const CObservationPointCloud& o, RayMaker& rays) {
    if (o.pointcloud)
        addPoints(o.pointcloud->getPointsBufferRef_x(), o.pointcloud->getPointsBufferRef_y(),
                  o.pointcloud->getPointsBufferRef_z(), rays);
}

void addScan(const CObservation2DRangeScan& o, RayMaker& rays) {
    for (std::size_t i = 0; i < o.getScanSize(); i++) {
        const bool hit = o.getScanRangeValidity(i);
        if (!hit && !rays.withFree()) continue;
        const double range = hit ? o.getScanRange(i) : o.maxRange, angle = o.getScanAngle(i);
        rays.add(range * std::cos(angle), range * std::sin(angle), 0, hit);
    }
}

#if AKIMAP_HAS_ROTATING_SCAN
void addScan(const CObservationRotatingScan& o, RayMaker& rays) {
    if (o.organizedPoints.size() == 0) return;
    if (o.rangeImage.rows() != o.organizedPoints.rows() ||
        o.rangeImage.cols() != o.organizedPoints.cols())
        throw std::runtime_error("CObservationRotatingScan '" + o.sensorLabel +
                                 "': range image and organized points are not of one size");
    for (int r = 0; r < o.organizedPoints.rows(); r++)
        for (int c = 0; c < o.organizedPoints.cols(); c++) {
            if (o.rangeImage(r, c) == 0) continue;
            const auto& p = o.organizedPoints(r, c);
            rays.add(p.x, p.y, p.z);
        }
}
#endif

/** Receives decoded Velodyne points; each packet has a time and so a pose of its own. */
class PacketRays : public CObservationVelodyneScan::PointCloudStorageWrapper {
 public:
    PacketRays(const CPose3D& sensor_on_robot, const AkiMap::RobotPoseAt& robot_pose_at,
               std::vector<Ray>& rays, bool with_free)
        : sensor_on_robot_(sensor_on_robot),
          robot_pose_at_(robot_pose_at),
          rays_(rays),
          with_free_(with_free) {}
    /** Points farther away [m] are beams of that length without a return. */
    void endAt(double range) { range_ = range; }
    void add_point(float x, float y, float z, uint8_t /*intensity*/,
                   const mrpt::system::TTimeStamp& time, const float /*azimuth*/,
                   uint16_t /*laser*/) override {
        if (!have_time_ || time != time_) placeAt(time);
        if (!maker_) return;
        const double d = range_ ? std::hypot(x, y, z) : 0;
        if (range_ && d > *range_)
            maker_->add(x * *range_ / d, y * *range_ / d, z * *range_ / d, false);
        else
            maker_->add(x, y, z);
    }

 private:
    void placeAt(const mrpt::system::TTimeStamp& time) {
        have_time_ = true, time_ = time;
        const auto robot = robot_pose_at_(time);
        if (robot)
            maker_.emplace(*robot + sensor_on_robot_, rays_, with_free_);
        else
            maker_.reset();
    }
    const CPose3D& sensor_on_robot_;
    const AkiMap::RobotPoseAt& robot_pose_at_;
    std::vector<Ray>& rays_;
    bool with_free_;
    std::optional<double> range_;
    bool have_time_ = false;
    mrpt::system::TTimeStamp time_;
    std::optional<RayMaker> maker_;
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
            for (auto& r : block.laser_returns)
                if (r.distance() == 0)  // its first two bytes, in either order
                    std::memset(static_cast<void*>(&r), 0xff, sizeof(uint16_t));
    receiver.endAt(std::min(o.maxRange, kBelowLargest));
    all.maxRange = 2 * kBelowLargest;
    decodePackets(all, receiver);
}

void addVelodyne(const CObservationVelodyneScan& o, const AkiMap::RobotPoseAt& robot_pose_at,
                 bool moving, bool with_free, std::vector<Ray>& rays) {
    PacketRays receiver(o.sensorPose, robot_pose_at, rays, with_free);
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

bool isLoaded(const CObservation3DRangeScan& o) {
    return (o.hasRangeImage && o.rangeImage.size() > 0) || !o.points3D_x.empty();
}
bool isLoaded(const CObservationPointCloud& o) {
    return o.pointcloud && !o.pointcloud->empty();
}
template <class T>
bool isLoaded(const T&) {
    return true;
}
/** Externally stored data are loaded into the const observation, each time anew: once is enough,
 * and one thread at a time. */
template <class T>
void loadOnce(const T& o) {
    static std::mutex one_at_a_time;
    const std::lock_guard<std::mutex> lock(one_at_a_time);
    if (!isLoaded(o)) o.load();
}

/** If obs is a T: loads it, adds its rays from the pose at its time, and returns true. */
template <class T>
bool addIf(const CObservation& obs, const AkiMap::RobotPoseAt& robot_pose_at, bool with_free,
           std::vector<Ray>& rays) {
    const auto* o = dynamic_cast<const T*>(&obs);
    if (!o) return false;
    loadOnce(*o);
    if (const auto robot = robot_pose_at(o->timestamp)) {
        RayMaker maker(*robot + o->sensorPose, rays, with_free);
        addScan(*o, maker);
    }
    return true;
}

template <class... T>
bool isAny(const CObservation& obs) {
    return (... || (dynamic_cast<const T*>(&obs) != nullptr));
}

}  // namespace

bool givesRays(const CObservation& obs) {
    return isAny<CObservation3DRangeScan, CObservationVelodyneScan, CObservationPointCloud,
#if AKIMAP_HAS_ROTATING_SCAN
                 CObservationRotatingScan,
#endif
                 CObservation2DRangeScan>(obs);
}

std::optional<std::vector<Ray>> raysOf(const CObservation& obs,
                                       const AkiMap::RobotPoseAt& robot_pose_at, bool moving,
                                       bool with_free) {
    std::vector<Ray> rays;
    if (const auto* velodyne = dynamic_cast<const CObservationVelodyneScan*>(&obs)) {
        addVelodyne(*velodyne, robot_pose_at, moving, with_free, rays);
        return rays;
    }
    if (addIf<CObservation3DRangeScan>(obs, robot_pose_at, with_free, rays) ||
        addIf<CObservationPointCloud>(obs, robot_pose_at, with_free, rays) ||
#if AKIMAP_HAS_ROTATING_SCAN
        addIf<CObservationRotatingScan>(obs, robot_pose_at, with_free, rays) ||
#endif
        addIf<CObservation2DRangeScan>(obs, robot_pose_at, with_free, rays))
        return rays;
    return std::nullopt;
}

}  // namespace akimap
