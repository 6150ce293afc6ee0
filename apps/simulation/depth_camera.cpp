// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <mrpt/core/Clock.h>
#include <mrpt/obs/CObservation3DRangeScan.h>

#include <cmath>

#include "simulation/sensors.h"

namespace akimap::app {

using mrpt::math::TVector3D;

namespace {

constexpr int kColumns = 80, kRows = 46;
constexpr double kHalfWidth = 1.19;                     // tan 50 deg
constexpr double kFocal = 0.5 * kColumns / kHalfWidth;  // [pixels]
constexpr double kHalfHeight = 0.5 * kRows / kFocal;
constexpr double kCentreX = 0.5 * (kColumns - 1), kCentreY = 0.5 * (kRows - 1);
constexpr double kUnit = 0.001;    // [m] of the range image
constexpr double kMinRange = 0.3;  // [m]
constexpr double kDegree = M_PI / 180;

mrpt::obs::CObservation3DRangeScan::Ptr makeObservation(const World& world, double time) {
    auto obs = mrpt::obs::CObservation3DRangeScan::Create();
    obs->sensorLabel = "DEPTH";
    obs->timestamp = mrpt::Clock::fromDouble(time);
    // Looks somewhat down: there is nothing to see above the walls.
    obs->sensorPose = {0.2, 0.03, 0.6, 2 * kDegree, 10 * kDegree, 0};
    obs->maxRange = static_cast<float>(world.max_range);
    obs->stdError = static_cast<float>(world.range_noise);
    obs->cameraParams.ncols = kColumns;
    obs->cameraParams.nrows = kRows;
    obs->cameraParams.setIntrinsicParamsFromValues(kFocal, kFocal, kCentreX, kCentreY);
    obs->cameraParamsIntensity = obs->cameraParams;
    obs->hasRangeImage = true;
    obs->range_is_depth = true;
    obs->rangeUnits = static_cast<float>(kUnit);
    obs->rangeImage_setSize(kRows, kColumns);
    return obs;
}

}  // namespace

SimulatedScan takeDepthScan(const World& world, double time, Random& random) {
    const auto obs = makeObservation(world, time);
    SimulatedScan scan{obs, time, world.trajectory.at(time), {}, {}};
    const mrpt::poses::CPose3D sensor = scan.robot_pose + obs->sensorPose;
    const mrpt::math::TPoint3D origin = sensor.translation();
    scan.rays.reserve(kColumns * kRows);
    for (int r = 0; r < kRows; r++)
        for (int c = 0; c < kColumns; c++) {
            const TVector3D pixel(1, (kCentreX - c) / kFocal, (kCentreY - r) / kFocal);
            const TVector3D direction = pixel.unitarize();
            const auto range =
                measureRange(world, origin, sensor.rotateVector(direction), kMinRange, random);
            const long units = range ? std::lround(*range * direction.x / kUnit) : 0;
            obs->rangeImage(r, c) = static_cast<uint16_t>(units);
            if (units > 0)
                scan.rays.push_back(rayTo(sensor, pixel * (static_cast<double>(units) * kUnit)));
        }
    scan.views.push_back(
        {sensor, FieldOfView::image(kHalfWidth, kHalfHeight), kMinRange, world.max_range});
    return scan;
}

}  // namespace akimap::app
