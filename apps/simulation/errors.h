// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

namespace akimap::app {

/** What is wrong with a sensor's ranges. All of it 0: exact ranges to the first surface. */
struct RangeErrors {
    double constant = 0;   ///< [m] >= 0. Standard deviation along the ray
    double linear = 0;     ///< [m/m] >= 0. The same that grows with the range
    double disparity = 0;  ///< [1/m] >= 0. Standard deviation of 1/depth: grows with its square
    double disparity_step = 0;  ///< [1/m] >= 0. 1/depth is rounded to multiples of it
    double range_step = 0;      ///< [m] >= 0. The range is rounded to multiples of it
    double beam_offset = 0;     ///< [m] >= 0. Standard deviation of each lidar beam's own offset
    double beam = 0;            ///< [rad] 0 to 0.1. Width of what a pixel or pulse sees
    /** [m] >= 0. A pixel on an edge: two surfaces so close give a range between theirs (a mixed
     * pixel), those farther apart one of both ranges. */
    double mixing = 0;
    /** 0 to 1. Cosine of the angle of incidence below which returns are lost, the flatter the
     * more, up to all at a right angle to the normal. */
    double grazing = 0;
    double dark_loss = 0;   ///< 0 to 1. Share of the returns lost off dark things
    double glass_pass = 0;  ///< 0 to 1. Share of the rays that see through glass
};

/** \exception std::runtime_error naming the error that can't be */
void check(const RangeErrors& errors);

/** How wrong the recorded poses are; 0: they are exact. Standard deviations, on each axis. The
 * error is the same for all of a scan, which is rigid. */
struct PoseErrors {
    double position = 0;        ///< [m] >= 0. White: each scan's is its own
    double angle = 0;           ///< [rad] >= 0. White
    double drift_position = 0;  ///< [m] >= 0. What each scan adds to the last one's, from 0 on
    double drift_angle = 0;     ///< [rad] >= 0

    [[nodiscard]] bool any() const {
        return position > 0 || angle > 0 || drift_position > 0 || drift_angle > 0;
    }
};

/** \exception std::runtime_error naming the error that can't be */
void check(const PoseErrors& errors);

}  // namespace akimap::app
