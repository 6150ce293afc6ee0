// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "pictures/colors.h"

namespace akimap::app {

/** A picture with depth, into which quadrilaterals are drawn. It needs no graphics driver and
 * no display, and draws the same picture everywhere. (MRPT's CFBORender works only where EGL does,
 * and took 4 s and 1.1 GB for 4 million triangles; this takes 7 bytes a pixel and no triangles.) */
class Raster {
 public:
    struct Vertex {
        float x, y;      ///< [pixels], y downwards
        float nearness;  ///< 1 / depth: linear on the screen
        float brightness;
    };

    Raster(int width, int height);
    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }

    /** Draws a convex quadrilateral, corners in order; its rim is drawn darker by `rim`. */
    void fill(const std::array<Vertex, 4>& corners, const Color& color, float rim);

    [[nodiscard]] bool isEmpty(int x, int y) const { return nearness_[at(x, y)] == 0; }
    [[nodiscard]] float nearness(int x, int y) const { return nearness_[at(x, y)]; }
    [[nodiscard]] Color color(int x, int y) const;

 private:
    struct Corner {
        Vertex vertex;
        float u, v;  // in the face, 0 to 1
    };
    void fillTriangle(const Corner& a, const Corner& b, const Corner& c, const Color& color,
                      float rim);
    [[nodiscard]] std::size_t at(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
               static_cast<std::size_t>(x);
    }

    int width_, height_;
    std::vector<float> nearness_;  // 0: nothing there
    std::vector<std::array<uint8_t, 3>> colors_;
};

}  // namespace akimap::app
