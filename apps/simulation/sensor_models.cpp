// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "simulation/sensor_models.h"

#include <cmath>

namespace akimap::app {

namespace {

constexpr double kDegree = M_PI / 180;
constexpr double kRange = 8;  // [m] of the three plain kinds: all of the room but its far corners

RangeErrors plainNoise() {
    RangeErrors errors;
    errors.constant = 0.01;
    return errors;
}

/** What no maker tells: chosen by us, so that dark, flat and glass things are seen badly. */
RangeErrors withLosses(RangeErrors errors) {
    errors.grazing = 0.2, errors.dark_loss = 0.6, errors.glass_pass = 0.9;
    return errors;
}

/** Khoshelham and Oude Elberink, "Accuracy and Resolution of Kinect Depth Data for Indoor Mapping
 * Applications", Sensors 12 (2012): 585 pixels of focal length, baseline 7.5 cm, disparities in
 * eighths of a pixel: 1/depth in steps of 0.125 / (585 * 0.075) = 2.85e-3 / m; its error half a
 * step in all (depth: 1.42e-3 / m times its square), of which rounding is 1 / sqrt(12) of a step;
 * range 0.5 to 5 m; matched by windows of 9 pixels. The 1 mm is that of its depth pictures. */
SensorModel kinect() {
    constexpr double kStep = 2.85e-3, kFocal = 585;
    RangeErrors errors;
    errors.constant = 0.001;
    errors.disparity = kStep * std::sqrt(0.25 - 1.0 / 12), errors.disparity_step = kStep;
    errors.beam = 9 / kFocal, errors.mixing = 0.1;
    return {Pattern::image, 160, 120, 0.5 * 640 / kFocal, 0, 0, 0.5, 5, withLosses(errors)};
}

/** "Intel RealSense Depth Camera D400-Series Datasheet" (2017): depth field of view of 85.2 x 58
 * degrees, baseline 50 mm, 0.11 to 10 m (here from 0.3 m); with 848 pixels a focal length of 461.
 * Intel, "Subpixel Linearity Improvement for Intel RealSense Depth Camera D400 Series": disparities
 * in steps of 1/32 pixel. Its error of 0.1 pixel is ours: it is 1.7 % at 4 m, and the datasheet
 * allows 2 %. */
SensorModel realsense() {
    constexpr double kHalfWidth = 0.9195;  // tan 42.6 deg
    constexpr double kFocal = 0.5 * 848 / kHalfWidth, kBaseline = 0.05;
    RangeErrors errors;
    errors.disparity = 0.1 / (kFocal * kBaseline);
    errors.disparity_step = 1.0 / 32 / (kFocal * kBaseline);
    errors.beam = 7 / kFocal, errors.mixing = 0.1;
    return {Pattern::image, 212, 120, kHalfWidth, 0, 0, 0.3, 10, withLosses(errors)};
}

/** "VLP-16 User Manual", Velodyne 63-9243: 16 beams from -15 to 15 degrees, up to 100 m, typical
 * accuracy +-3 cm, taken for one standard deviation; beams of 3 mrad, steps of 2 mm (of the
 * packets). */
SensorModel vlp16() {
    RangeErrors errors;
    errors.constant = 0.03;
    errors.beam = 0.003, errors.mixing = 0.5;
    return {Pattern::packets, 900, 16, 0, 15 * kDegree, 1, 1, 100, withLosses(errors)};
}

/** As measured on a recording of a lidar of 64 beams from -45 to 45 degrees, by bench_range_noise
 * (doc/design.md): in a patch of two rings 3.5 mm near by and more far off; in patches of more,
 * what looks like offsets of each ring's own. Departs from the datasheet of the OS1, which vouches
 * for a repeatability of 1.5 cm at its best. Beams are as wide as that datasheet has them. */
RangeErrors ousterErrors() {
    RangeErrors errors;
    errors.constant = 0.0035, errors.linear = 0.0009, errors.beam_offset = 0.012;
    errors.beam = 0.18 * kDegree, errors.mixing = 0.5;
    return withLosses(errors);
}

/** "OS1 High Resolution Imaging LIDAR", Ouster's datasheet: 128 beams from -22.5 to 22.5 degrees,
 * 1024 directions, 0.8 to 120 m, beams of 0.18 degrees. */
SensorModel os1() {
    return {Pattern::rings, 1024, 128, 0, 22.5 * kDegree, 1, 0.8, 120, ousterErrors()};
}

/** As that recording shows it: 64 beams from -45 to 45 degrees; 50 m. */
SensorModel os0() {
    return {Pattern::rings, 2048, 64, 0, 45 * kDegree, 1, 0.8, 50, ousterErrors()};
}

}  // namespace

SensorModel sensorModel(SensorKind kind) {
    switch (kind) {
        case SensorKind::kinect:
            return kinect();
        case SensorKind::realsense:
            return realsense();
        case SensorKind::vlp16:
            return vlp16();
        case SensorKind::os1_128:
            return os1();
        case SensorKind::os0_64:
            return os0();
        case SensorKind::velodyne:
            return {Pattern::packets, 900, 16, 0, 15 * kDegree, 4, 1, kRange, plainNoise()};
        case SensorKind::pointcloud:
            return {Pattern::random, 3600, 1, 0, 0, 1, 0.3, kRange, plainNoise()};
        default:
            return {Pattern::image, 80, 46, 1.19, 0, 1, 0.3, kRange, plainNoise()};
    }
}

}  // namespace akimap::app
