// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "input/depth/depth_observation.h"

#include <stdexcept>
#include <string>

namespace akimap::app {

namespace {

using mrpt::poses::CPose3D;

/** MRPT's sensor frame (x ahead, y left, z up) in the camera's (z ahead, x right, y down). */
CPose3D mrptInCamera() {
    mrpt::math::CMatrixDouble44 m = mrpt::math::CMatrixDouble44::Zero();
    m(2, 0) = 1, m(0, 1) = -1, m(1, 2) = -1, m(3, 3) = 1;
    return CPose3D(m);
}

}  // namespace

mrpt::obs::CObservation3DRangeScan::Ptr depthObservation(
    unsigned width, unsigned height, const Intrinsics& camera, double metres_per_step,
    const std::function<uint16_t(unsigned x, unsigned y)>& steps_at) {
    constexpr uint16_t kNoDepth = 65535;  // besides 0
    if (camera.cx >= width || camera.cy >= height)
        throw std::runtime_error("an image of " + std::to_string(width) + " x " +
                                 std::to_string(height) +
                                 " pixels does not hold the centre that its intrinsics say");
    auto depth = mrpt::obs::CObservation3DRangeScan::Create();
    depth->timestamp = INVALID_TIMESTAMP;
    depth->sensorPose = mrptInCamera();
    depth->hasRangeImage = true;
    depth->range_is_depth = true;
    depth->rangeUnits = static_cast<float>(metres_per_step);
    depth->cameraParams.ncols = width;
    depth->cameraParams.nrows = height;
    depth->cameraParams.setIntrinsicParamsFromValues(camera.fx, camera.fy, camera.cx, camera.cy);
    depth->rangeImage_setSize(static_cast<int>(height), static_cast<int>(width));
    for (unsigned y = 0; y < height; y++)
        for (unsigned x = 0; x < width; x++) {
            const uint16_t steps = steps_at(x, y);
            depth->rangeImage(static_cast<int>(y), static_cast<int>(x)) =
                steps == kNoDepth ? uint16_t{0} : steps;
        }
    return depth;
}

}  // namespace akimap::app
