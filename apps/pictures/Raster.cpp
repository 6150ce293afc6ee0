// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "pictures/Raster.h"

#include <algorithm>
#include <cmath>

namespace akimap::app {

namespace {

/** A value that is linear over a triangle: base + dx * x + dy * y. */
struct Plane {
    float base, dx, dy;
    [[nodiscard]] float operator()(float x, float y) const { return base + dx * x + dy * y; }
};

/** Weights of the corners of a triangle, each 1 at its corner and 0 at the other two. */
struct Weights {
    Plane a, b, c;
    [[nodiscard]] Plane blend(float at_a, float at_b, float at_c) const {
        return {at_a * a.base + at_b * b.base + at_c * c.base,
                at_a * a.dx + at_b * b.dx + at_c * c.dx, at_a * a.dy + at_b * b.dy + at_c * c.dy};
    }
};

uint8_t toByte(float v) {
    return static_cast<uint8_t>(std::clamp(v, 0.f, 1.f) * 255 + 0.5f);
}

}  // namespace

Raster::Raster(int width, int height)
    : width_(width),
      height_(height),
      nearness_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0.f),
      colors_(nearness_.size()) {}

Color Raster::color(int x, int y) const {
    const auto& c = colors_[at(x, y)];
    return {static_cast<float>(c[0]) / 255, static_cast<float>(c[1]) / 255,
            static_cast<float>(c[2]) / 255};
}

void Raster::fill(const std::array<Vertex, 4>& corners, const Color& color, float rim) {
    const Corner c[4] = {
        {corners[0], 0, 0}, {corners[1], 1, 0}, {corners[2], 1, 1}, {corners[3], 0, 1}};
    // Cut along the diagonal that joins the corners more alike: else dark corners look frayed.
    const auto difference = [&](int i, int j) {
        return std::abs(c[i].vertex.brightness - c[j].vertex.brightness);
    };
    const int first = difference(0, 2) <= difference(1, 3) ? 0 : 1;
    fillTriangle(c[first], c[first + 1], c[(first + 2) % 4], color, rim);
    fillTriangle(c[first], c[(first + 2) % 4], c[(first + 3) % 4], color, rim);
}

void Raster::fillTriangle(const Corner& a, const Corner& b, const Corner& c, const Color& color,
                          float rim) {
    const Vertex &A = a.vertex, &B = b.vertex, &C = c.vertex;
    const float area = (B.x - A.x) * (C.y - A.y) - (B.y - A.y) * (C.x - A.x);
    if (std::abs(area) < 1e-6f) return;
    const auto weight = [&](const Vertex& p, const Vertex& q) {  // 0 on the line p-q
        return Plane{(p.x * q.y - p.y * q.x) / area, (p.y - q.y) / area, (q.x - p.x) / area};
    };
    const Weights w{weight(B, C), weight(C, A), weight(A, B)};
    const Plane nearness = w.blend(A.nearness, B.nearness, C.nearness);
    const Plane brightness = w.blend(A.brightness, B.brightness, C.brightness);
    const Plane u = w.blend(a.u, b.u, c.u), v = w.blend(a.v, b.v, c.v);

    const auto low = [](float p, float q, float r) {
        return std::max(0, static_cast<int>(std::ceil(std::min({p, q, r}) - 0.5f)));
    };
    const auto high = [](float p, float q, float r, int size) {
        return std::min(size - 1, static_cast<int>(std::floor(std::max({p, q, r}) - 0.5f)));
    };
    constexpr float kRimWidth = 0.07f, kSeam = -1e-3f;  // triangles overlap a little: no seams
    for (int j = low(A.y, B.y, C.y); j <= high(A.y, B.y, C.y, height_); j++) {
        const float y = static_cast<float>(j) + 0.5f;
        for (int i = low(A.x, B.x, C.x); i <= high(A.x, B.x, C.x, width_); i++) {
            const float x = static_cast<float>(i) + 0.5f;
            if (w.a(x, y) < kSeam || w.b(x, y) < kSeam || w.c(x, y) < kSeam) continue;
            float& there = nearness_[at(i, j)];
            if (const float here = nearness(x, y); here > there) {
                there = here;
                const float s = u(x, y), t = v(x, y);
                const bool at_rim = std::min({s, t, 1 - s, 1 - t}) < kRimWidth;
                const Color shaded = color * (brightness(x, y) * (at_rim ? 1 - rim : 1));
                colors_[at(i, j)] = {toByte(shaded.r), toByte(shaded.g), toByte(shaded.b)};
            }
        }
    }
}

}  // namespace akimap::app
