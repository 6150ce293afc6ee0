// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <mrpt/math/TPoint3D.h>
#include <mrpt/poses/CPose3D.h>

#include <algorithm>
#include <cmath>

namespace akimap::app {

/** The directions that a sensor sees, in its frame (x forward, y left, z up). */
class FieldOfView {
 public:
    /** A camera's image. \param half_width, half_height  |y/x| and |z/x| at the image's edges */
    static FieldOfView image(double half_width, double half_height) {
        return {true, 0, half_width, -half_height, half_height};
    }
    /** A spinning sensor's band, or a sector of it. [rad] */
    static FieldOfView band(double azimuth, double half_width, double low, double high) {
        return {false, azimuth, half_width, low, high};
    }

    /** \param d  of any length */
    [[nodiscard]] bool contains(const mrpt::math::TVector3D& d) const {
        if (image_)
            return std::abs(d.y) <= half_width_ * d.x && d.z >= low_ * d.x && d.z <= high_ * d.x;
        const double level = std::sqrt(d.x * d.x + d.y * d.y);
        return d.z >= tan_low_ * level && d.z <= tan_high_ * level &&
               cos_azimuth_ * d.x + sin_azimuth_ * d.y >= cos_half_width_ * level;
    }

    /** Calls visit(unit direction, n) for directions at most `spacing` [rad] apart, edges included.
     * The directions with n >= k are those of a grid of 2^k times the spacing. */
    template <class Visitor>
    void forEachDirection(double spacing, Visitor&& visit) const {
        const int rows = steps(high_ - low_, spacing);
        for (int i = 0; i <= rows; i++) {
            const double v = low_ + (high_ - low_) * i / rows;
            const int columns = steps(2 * half_width_ * (image_ ? 1 : std::cos(v)), spacing);
            for (int j = 0; j <= columns; j++)
                visit(direction(half_width_ * (2.0 * j / columns - 1), v), doublings(i | j));
        }
    }

 private:
    FieldOfView(bool image, double azimuth, double half_width, double low, double high)
        : image_(image), azimuth_(azimuth), half_width_(half_width), low_(low), high_(high) {}

    [[nodiscard]] static int steps(double extent, double spacing) {
        return std::max(1, static_cast<int>(std::ceil(extent / spacing)));
    }
    [[nodiscard]] static int doublings(int index) {
        int n = 0;
        while (n < 30 && !(index >> n & 1)) n++;
        return n;
    }
    [[nodiscard]] mrpt::math::TVector3D direction(double u, double v) const {
        if (image_) return mrpt::math::TVector3D(1, u, v).unitarize();
        const double a = azimuth_ + u;
        return {std::cos(v) * std::cos(a), std::cos(v) * std::sin(a), std::sin(v)};
    }

    bool image_;  // the bounds are tangents in the image's plane, else angles
    double azimuth_, half_width_, low_, high_;
    double tan_low_ = std::tan(low_), tan_high_ = std::tan(high_);
    double cos_azimuth_ = std::cos(azimuth_), sin_azimuth_ = std::sin(azimuth_);
    double cos_half_width_ = half_width_ < M_PI ? std::cos(half_width_) : -2;
};

/** What a sensor sees from one place. */
struct View {
    mrpt::poses::CPose3D sensor;  ///< in the map
    FieldOfView field;
    double min_range, max_range;  ///< [m]
};

}  // namespace akimap::app
