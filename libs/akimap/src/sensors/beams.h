// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <mrpt/maps/CPointsMap.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/obs/CObservationRotatingScan.h>

#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "mrpt/mrpt_compat.h"

// The one decoder of observations, for insertion and for the likelihood: forEachBeam(observation,
// with_free, visit) calls visit(x, y, z, hit) with the end [m] of each beam in the sensor's frame.
// Returns that the sensor marks invalid are left out; with_free, they are beams of the
// observation's maxRange without a hit. The observation must be loaded. Concurrent calls are safe.

namespace akimap {

/** Held around what MRPT changes inside const observations, or behind them. */
std::mutex& observationMutex();

/** Loads externally stored data into the const observation, unless they are there: MRPT would read
 * them anew each time. Thread-safe. */
void loadOnce(const mrpt::obs::CObservation3DRangeScan& o);
void loadOnce(const mrpt::obs::CObservationPointCloud& o);
void loadOnce(const mrpt::obs::CObservation& o);

/** The direction of each beam of a 2D scan: cosine and sine. Kept for the last scan of each thread,
 * as a particle filter asks for the same scan thousands of times. */
const std::vector<std::pair<double, double>>& directionsOf(
    const mrpt::obs::CObservation2DRangeScan& o);

/** Where each pixel of a depth image looks: what a range of 1 is in the sensor's frame. */
struct PixelDirections {
    std::vector<float> x, y, z;
};
/** Those of the camera, for all its images. Not MRPT's own table: that is filled after MRPT has let
 * go of its lock, and freed under its readers when there are more than 100.
 * \exception std::runtime_error unless the image is as large as the camera's */
std::shared_ptr<const PixelDirections> pixelDirectionsOf(
    const mrpt::obs::CObservation3DRangeScan& o);

template <class Visitor>
void forEachBeam(const mrpt::obs::CObservation2DRangeScan& o, bool with_free, Visitor&& visit) {
    const auto& directions = directionsOf(o);
    for (std::size_t i = 0; i < directions.size(); i++) {
        const bool hit = o.getScanRangeValidity(i);
        if (!hit && !with_free) continue;
        const double range = hit ? o.getScanRange(i) : o.maxRange;
        visit(range * directions[i].first, range * directions[i].second, 0.0, hit);
    }
}

template <class Floats, class Visitor>
void forEachPoint(const Floats& x, const Floats& y, const Floats& z, Visitor&& visit) {
    for (std::size_t i = 0; i < x.size(); i++)
        visit(static_cast<double>(x[i]), static_cast<double>(y[i]), static_cast<double>(z[i]),
              true);
}

template <class Visitor>
void forEachBeam(const mrpt::obs::CObservationPointCloud& o, bool, Visitor&& visit) {
    if (!o.pointcloud) return;
    forEachPoint(o.pointcloud->getPointsBufferRef_x(), o.pointcloud->getPointsBufferRef_y(),
                 o.pointcloud->getPointsBufferRef_z(), visit);
}

/** Depth images are preferred to points3D, which other maps are known to shrink in place. */
template <class Visitor>
void forEachBeam(const mrpt::obs::CObservation3DRangeScan& o, bool with_free, Visitor&& visit) {
    const auto n = o.hasRangeImage ? static_cast<std::size_t>(o.rangeImage.size()) : 0;
    if (n == 0) {
        if (o.hasPoints3D) forEachPoint(o.points3D_x, o.points3D_y, o.points3D_z, visit);
        return;
    }
    const auto directions = pixelDirectionsOf(o);
    const uint16_t* range = o.rangeImage.data();
    for (std::size_t i = 0; i < n; i++) {
        const bool hit = range[i] != 0;
        if (!hit && !with_free) continue;
        const double d = hit ? range[i] * static_cast<double>(o.rangeUnits) : o.maxRange;
        visit(d * directions->x[i], d * directions->y[i], d * directions->z[i], hit);
    }
}

#if AKIMAP_HAS_ROTATING_SCAN
template <class Visitor>
void forEachBeam(const mrpt::obs::CObservationRotatingScan& o, bool, Visitor&& visit) {
    if (o.organizedPoints.size() == 0) return;
    if (o.rangeImage.rows() != o.organizedPoints.rows() ||
        o.rangeImage.cols() != o.organizedPoints.cols())
        throw std::runtime_error("CObservationRotatingScan '" + o.sensorLabel +
                                 "': range image and organized points are not of one size");
    for (int r = 0; r < o.organizedPoints.rows(); r++)
        for (int c = 0; c < o.organizedPoints.cols(); c++) {
            if (o.rangeImage(r, c) == 0) continue;
            const auto& p = o.organizedPoints(r, c);
            visit(static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z),
                  true);
        }
}
#endif

/** Calls visit(observation as its own class) if forEachBeam() takes it. \return whether it does */
template <class Visitor>
bool visitAsItsClass(const mrpt::obs::CObservation& obs, Visitor&& visit) {
    using namespace mrpt::obs;
    const auto tryAs = [&](const auto* o) { return o ? (visit(*o), true) : false; };
    return tryAs(dynamic_cast<const CObservation2DRangeScan*>(&obs)) ||
#if AKIMAP_HAS_ROTATING_SCAN
           tryAs(dynamic_cast<const CObservationRotatingScan*>(&obs)) ||
#endif
           tryAs(dynamic_cast<const CObservationPointCloud*>(&obs)) ||
           tryAs(dynamic_cast<const CObservation3DRangeScan*>(&obs));
}
[[nodiscard]] inline bool isDecodable(const mrpt::obs::CObservation& obs) {
    return visitAsItsClass(obs, [](const auto&) {});
}
/** The same with the observation loaded. */
template <class Visitor>
bool visitDecodable(const mrpt::obs::CObservation& obs, Visitor&& visit) {
    return visitAsItsClass(obs, [&](const auto& o) {
        loadOnce(o);
        visit(o);
    });
}

}  // namespace akimap
