// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "simulation/Walk.h"

#include <algorithm>
#include <cmath>

namespace akimap::app {

namespace {

/** [m] gone at that time. */
double wayAt(const Walk& walk, double time) {
    const double halfway = 0.5 * (walk.end() - walk.start - walk.stop);  // [s]
    const double passed = time - walk.start;
    return walk.speed * (passed < halfway ? passed : std::max(halfway, passed - walk.stop));
}

}  // namespace

double Walk::end() const {
    return start + std::hypot(to_x - from_x, to_y - from_y) / speed + stop;
}

std::vector<ShapePtr> Walk::at(double time) const {
    constexpr double kLeg = 0.07, kTrunk = 0.19, kHead = 0.11;    // [m] radii
    constexpr double kHip = 0.85, kNeck = 1.53, kTop = 1.75;      // [m] heights
    constexpr double kApart = 0.1, kSwing = 0.25, kStride = 1.4;  // [m] of the legs
    if (time < start || time >= end()) return {};
    const double way = wayAt(*this, time);
    const double heading = std::atan2(to_y - from_y, to_x - from_x);
    const double ux = std::cos(heading), uy = std::sin(heading);
    const double x = from_x + way * ux, y = from_y + way * uy, floor = Scene::floorHeight();
    std::vector<ShapePtr> body;
    for (const double side : {-1.0, 1.0}) {
        const double ahead = side * kSwing * std::sin(2 * M_PI * way / kStride);
        body.push_back(makePillar(x + ahead * ux - side * kApart * uy,
                                  y + ahead * uy + side * kApart * ux, kLeg, floor, floor + kHip));
    }
    body.push_back(makePillar(x, y, kTrunk, floor + kHip, floor + kNeck));
    body.push_back(makeSphere({x, y, floor + kTop - kHead}, kHead));
    return body;
}

Scene sceneAt(const Scene& scene, const Walk& walk, double time) {
    Scene now = scene;
    for (const ShapePtr& shape : walk.at(time)) now.add(shape);
    return now;
}

}  // namespace akimap::app
