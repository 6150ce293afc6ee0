// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <mrpt/core/Clock.h>
#include <mrpt/obs/CObservation3DRangeScan.h>

#include <cmath>

#include "simulation/sensors.h"

namespace akimap::app {

using mrpt::math::TVector3D;

namespace {

constexpr double kUnit = 0.001;  // [m] of the range image
constexpr double kDegree = M_PI / 180;

/** The image's geometry. [pixels] */
struct Lens {
    explicit Lens(const SensorModel& camera)
        : focal(0.5 * camera.columns / camera.half_width),
          centre_x(0.5 * (camera.columns - 1)),
          centre_y(0.5 * (camera.rows - 1)) {}
    double focal, centre_x, centre_y;
};

mrpt::obs::CObservation3DRangeScan::Ptr makeObservation(const SensorModel& camera,
                                                        const World& world, double time) {
    const Lens lens(camera);
    auto obs = mrpt::obs::CObservation3DRangeScan::Create();
    obs->sensorLabel = "DEPTH";
    obs->timestamp = mrpt::Clock::fromDouble(time);
    // Looks somewhat down: there is nothing to see above the walls.
    obs->sensorPose = {0.2, 0.03, 0.6, 2 * kDegree, 10 * kDegree, 0};
    obs->maxRange = static_cast<float>(world.max_range);
    obs->stdError = static_cast<float>(world.errors.constant);
    obs->cameraParams.ncols = static_cast<unsigned>(camera.columns);
    obs->cameraParams.nrows = static_cast<unsigned>(camera.rows);
    obs->cameraParams.setIntrinsicParamsFromValues(lens.focal, lens.focal, lens.centre_x,
                                                   lens.centre_y);
    obs->cameraParamsIntensity = obs->cameraParams;
    obs->hasRangeImage = true;
    obs->range_is_depth = true;
    obs->rangeUnits = static_cast<float>(kUnit);
    obs->rangeImage_setSize(camera.rows, camera.columns);
    return obs;
}

}  // namespace

SimulatedScan takeDepthScan(const SensorModel& camera, const World& world, double time,
                            Random& random) {
    const Lens lens(camera);
    const auto obs = makeObservation(camera, world, time);
    SimulatedScan scan{obs, time, world.trajectory.at(time), {}, {}};
    const mrpt::poses::CPose3D sensor = scan.robot_pose + obs->sensorPose;
    const mrpt::math::TPoint3D origin = sensor.translation();
    scan.rays.reserve(static_cast<std::size_t>(camera.columns * camera.rows));
    for (int r = 0; r < camera.rows; r++)
        for (int c = 0; c < camera.columns; c++) {
            const TVector3D pixel(1, (lens.centre_x - c) / lens.focal,
                                  (lens.centre_y - r) / lens.focal);
            const TVector3D direction = pixel.unitarize();
            const auto range = measureRange(world, origin, sensor.rotateVector(direction),
                                            camera.min_range, random, direction.x);
            const long units = range ? std::lround(*range * direction.x / kUnit) : 0;
            obs->rangeImage(r, c) = static_cast<uint16_t>(units);
            if (units > 0)
                scan.rays.push_back(rayTo(sensor, pixel * (static_cast<double>(units) * kUnit)));
        }
    scan.views.push_back({sensor,
                          FieldOfView::image(camera.half_width, 0.5 * camera.rows / lens.focal),
                          camera.min_range, world.max_range});
    return scan;
}

}  // namespace akimap::app
