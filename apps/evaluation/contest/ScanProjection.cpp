// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "evaluation/contest/ScanProjection.h"

#include <algorithm>
#include <cmath>

#include "evaluation/contest/beam.h"

namespace akimap::app {

namespace {

using Vector = std::array<double, 3>;

constexpr double kWidest = 0.26;   // cos 75 degrees
constexpr double kSteepest = 0.7;  // |cos| from which a camera counts as looking along z
constexpr double kStray = 0.002;   // share of the rays that may fall off each side

double dot(const Vector& a, const Vector& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Vector cross(const Vector& a, const Vector& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Vector normalized(Vector v) {
    const double length = std::sqrt(dot(v, v));
    for (double& x : v) x /= length;
    return v;
}

/** From just above the lowest to just below the highest. */
std::array<double, 2> range(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const auto stray = static_cast<std::size_t>(kStray * static_cast<double>(values.size()));
    const double low = values[stray], high = values[values.size() - 1 - stray];
    return {low, std::max(high, low + 1e-3)};
}

}  // namespace

ScanProjection::ScanProjection(const std::vector<Ray>& rays) {
    Vector sum{};
    for (const Ray& ray : rays)
        for (std::size_t i = 0; i < 3; i++) sum[i] += Beam(ray).direction[i];
    const double length = std::sqrt(dot(sum, sum));
    forward_ = length > 0 ? normalized(sum) : Vector{1, 0, 0};
    is_panorama_ = std::any_of(rays.begin(), rays.end(), [&](const Ray& ray) {
        return dot(Beam(ray).direction, forward_) < kWidest;
    });
    if (is_panorama_) forward_ = {1, 0, 0};
    const Vector up = std::abs(forward_[2]) < kSteepest ? Vector{0, 0, 1} : Vector{0, -1, 0};
    right_ = normalized(cross(forward_, up));
    up_ = cross(right_, forward_);

    std::vector<double> xs, ys;
    for (const Ray& ray : rays) {
        const Place p = flat(ray);
        xs.push_back(p.x), ys.push_back(p.y);
    }
    const auto x = range(xs), y = range(ys);
    left_ = x[0], top_ = y[0];
    width_ = x[1] - x[0], height_ = y[1] - y[0];
}

ScanProjection::Place ScanProjection::flat(const Ray& ray) const {
    const Vector d = Beam(ray).direction;
    const double ahead = dot(d, forward_), x = dot(d, right_), y = -dot(d, up_);
    if (is_panorama_) return {std::atan2(x, ahead), std::asin(std::clamp(y, -1.0, 1.0))};
    return {x / ahead, y / ahead};
}

ScanProjection::Place ScanProjection::operator()(const Ray& ray) const {
    const Place p = flat(ray);
    return {(p.x - left_) / width_, (p.y - top_) / height_};
}

}  // namespace akimap::app
