// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "simulation/errors.h"

#include <limits>
#include <stdexcept>
#include <string>

namespace akimap::app {

namespace {

void checkValue(const std::string& what, double value, double most) {
    if (value >= 0 && value <= most) return;
    const std::string limit = most < 1e3 ? "from 0 to " + std::to_string(most) : "0 or more";
    throw std::runtime_error(what + ": " + std::to_string(value) + ", but it must be " + limit);
}

constexpr double kMost = std::numeric_limits<double>::max();  // any finite one

}  // namespace

void check(const RangeErrors& errors) {
    checkValue("range noise [m]", errors.constant, kMost);
    checkValue("range noise that grows [m/m]", errors.linear, kMost);
    checkValue("disparity noise [1/m]", errors.disparity, kMost);
    checkValue("disparity step [1/m]", errors.disparity_step, kMost);
    checkValue("range step [m]", errors.range_step, kMost);
    checkValue("beam offset [m]", errors.beam_offset, kMost);
    checkValue("beam width [rad]", errors.beam, 0.1);
    checkValue("mixing depth [m]", errors.mixing, kMost);
    checkValue("grazing cosine", errors.grazing, 1);
    checkValue("loss off dark things", errors.dark_loss, 1);
    checkValue("rays through glass", errors.glass_pass, 1);
}

void check(const PoseErrors& errors) {
    checkValue("pose noise [m]", errors.position, kMost);
    checkValue("pose noise [rad]", errors.angle, kMost);
    checkValue("pose drift [m]", errors.drift_position, kMost);
    checkValue("pose drift [rad]", errors.drift_angle, kMost);
}

}  // namespace akimap::app
