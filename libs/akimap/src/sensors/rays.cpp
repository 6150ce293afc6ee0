// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <akimap/rays.h>

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/obs/CObservationRotatingScan.h>

#include <cmath>
#include <mutex>

#include "mrpt/mrpt_compat.h"
#include "sensors/RayAppender.h"
#include "sensors/velodyne_rays.h"

namespace akimap {
namespace {

using namespace mrpt::obs;
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
