// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "pictures/Camera.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace akimap::app {

namespace {

double dot(const Point& a, const Point& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

}  // namespace

Camera::Camera(const Point& center, double radius, double azimuth, double elevation)
    : distance_(4 * radius) {  // near enough for some perspective, too far to distort
    const double ca = std::cos(azimuth), sa = std::sin(azimuth);
    const double ce = std::cos(elevation), se = std::sin(elevation);
    forward_ = {-ca * ce, -sa * ce, -se};
    right_ = {-sa, ca, 0};
    up_ = {-ca * se, -sa * se, ce};
    for (std::size_t i = 0; i < 3; i++) eye_[i] = center[i] - distance_ * forward_[i];
}

Raster::Vertex Camera::project(const Point& p) const {
    const Point d{p[0] - eye_[0], p[1] - eye_[1], p[2] - eye_[2]};
    const double nearness = 1 / dot(d, forward_);
    return {static_cast<float>(shift_x_ + zoom_ * nearness * dot(d, right_)),
            static_cast<float>(shift_y_ - zoom_ * nearness * dot(d, up_)),
            static_cast<float>(nearness), 0};
}

void Camera::fit(const std::vector<Point>& points, const Frame& frame) {
    zoom_ = 1;
    shift_x_ = shift_y_ = 0;
    constexpr float kFar = std::numeric_limits<float>::max();
    float left = kFar, right = -kFar, top = kFar, bottom = -kFar;
    for (const Point& p : points) {
        const Raster::Vertex v = project(p);
        left = std::min(left, v.x), right = std::max(right, v.x);
        top = std::min(top, v.y), bottom = std::max(bottom, v.y);
    }
    const double width = right - left, height = bottom - top;
    zoom_ = std::min((frame.right - frame.left) / width, (frame.bottom - frame.top) / height);
    shift_x_ = (frame.left + frame.right - zoom_ * (left + right)) / 2;
    shift_y_ = (frame.top + frame.bottom - zoom_ * (top + bottom)) / 2;
}

}  // namespace akimap::app
