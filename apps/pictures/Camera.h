// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "pictures/Raster.h"

namespace akimap::app {

using Point = std::array<double, 3>;
[[nodiscard]] inline Point toPoint(const std::array<int32_t, 3>& p) {
    return {double(p[0]), double(p[1]), double(p[2])};
}

/** A rectangle of the picture [pixels], y downwards. */
struct Frame {
    double left, top, right, bottom;
};

/** A perspective camera that looks at a sphere from outside. */
class Camera {
 public:
    /** \param azimuth,elevation where the camera stands as seen from the centre [rad] */
    Camera(const Point& center, double radius, double azimuth, double elevation);

    /** Zooms and shifts the picture so that the points fill the frame. */
    void fit(const std::vector<Point>& points, const Frame& frame);
    /** Pixels per unit at the centre's distance. */
    [[nodiscard]] double scale() const { return zoom_ / distance_; }

    /** Brightness is left at 0. */
    [[nodiscard]] Raster::Vertex project(const Point& p) const;
    [[nodiscard]] const Point& eye() const { return eye_; }

 private:
    Point eye_, right_, up_, forward_;
    double distance_, zoom_ = 1, shift_x_ = 0, shift_y_ = 0;
};

}  // namespace akimap::app
