// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <akimap/Ray.h>
#include <akimap/rays.h>
#include <mrpt/maps/CPointsMap.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/obs/CObservationVelodyneScan.h>

#include <cmath>

// Room 1 for the likelihood, which a particle filter asks for thousands of times a scan: no list
// of rays is made, and the sensor's frame is turned into the map's once.

namespace akimap {

/** Places points of the sensor's frame in the map. */
class SensorFrame {
 public:
    explicit SensorFrame(const mrpt::poses::CPose3D& sensor)
        : origin_{sensor.x(), sensor.y(), sensor.z()} {
        const auto& R = sensor.getRotationMatrix();
        for (std::size_t i = 0; i < 3; i++)
            for (std::size_t j = 0; j < 3; j++)
                R_[i][j] = R(static_cast<int>(i), static_cast<int>(j));
    }
    [[nodiscard]] Ray rayTo(double x, double y, double z) const {
        Ray r{origin_, {}};
        for (std::size_t i = 0; i < 3; i++)
            r.end[i] = origin_[i] + R_[i][0] * x + R_[i][1] * y + R_[i][2] * z;
        return r;
    }

 private:
    std::array<double, 3> origin_;
    std::array<std::array<double, 3>, 3> R_{};
};

/** The beams of a scan are a fixed turn apart: no sine is taken for each. */
template <class Visitor>
void forEachReturnOf(const mrpt::obs::CObservation2DRangeScan& o, const SensorFrame& frame,
                     std::size_t decimation, Visitor& visit) {
    const std::size_t n = o.getScanSize();
    if (n == 0) return;
    const double first = o.getScanAngle(0);
    const double turn =
        n > decimation ? static_cast<double>(decimation) * (o.getScanAngle(1) - first) : 0;
    const double c = std::cos(turn), s = std::sin(turn);
    double x = std::cos(first), y = std::sin(first);
    for (std::size_t i = 0; i < n; i += decimation) {
        if (o.getScanRangeValidity(i)) {
            const double range = o.getScanRange(i);
            visit(frame.rayTo(range * x, range * y, 0));
        }
        const double next = c * x - s * y;
        y = s * x + c * y, x = next;
    }
}

template <class Floats, class Visitor>
void forEachPoint(const Floats& x, const Floats& y, const Floats& z, const SensorFrame& frame,
                  std::size_t decimation, Visitor& visit) {
    for (std::size_t i = 0; i < x.size(); i += decimation)
        visit(frame.rayTo(static_cast<double>(x[i]), static_cast<double>(y[i]),
                          static_cast<double>(z[i])));
}

/** Calls visit(Ray) for one in every `decimation` returns of an observation of a class that
 * givesRays(); the robot stands still. The observation is left as it was. */
template <class Visitor>
void forEachReturn(const mrpt::obs::CObservation& obs, const mrpt::poses::CPose3D& robot,
                   std::size_t decimation, Visitor&& visit) {
    using namespace mrpt::obs;
    if (const auto* scan = dynamic_cast<const CObservation2DRangeScan*>(&obs)) {
        scan->load();
        return forEachReturnOf(*scan, SensorFrame(robot + scan->sensorPose), decimation, visit);
    }
    if (const auto* cloud = dynamic_cast<const CObservationPointCloud*>(&obs)) {
        cloud->load();
        if (cloud->pointcloud)
            forEachPoint(cloud->pointcloud->getPointsBufferRef_x(),
                         cloud->pointcloud->getPointsBufferRef_y(),
                         cloud->pointcloud->getPointsBufferRef_z(),
                         SensorFrame(robot + cloud->sensorPose), decimation, visit);
        return;
    }
    const auto* velodyne = dynamic_cast<const CObservationVelodyneScan*>(&obs);
    if (velodyne) velodyne->load();
    if (velodyne && !velodyne->point_cloud.x.empty()) {
        const auto& p = velodyne->point_cloud;
        return forEachPoint(p.x, p.y, p.z, SensorFrame(robot + velodyne->sensorPose), decimation,
                            visit);
    }
    const auto rays = raysOf(obs, [&](mrpt::Clock::time_point) { return std::optional(robot); });
    for (std::size_t i = 0; rays && i < rays->size(); i += decimation) visit((*rays)[i]);
}

}  // namespace akimap
