// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
// Compiled without fused multiply-adds (see CMakeLists.txt): a rounded place decides on a cell.
#include "estimators/surface/free_rays.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "numeric/rows.h"

namespace akimap {
namespace {
constexpr double kClearance = 1.5;   // a ball's radius over its distance from the hit's plane
constexpr double kStep = 0.5;        // from ball to ball, over the radius
constexpr double kLeastBall = 0.25;  // [cells]
constexpr double kOffCenter = 0.9;  // [cells] balls are centred on cells: half a diagonal, rounding

/** Of a ray, away from its end: where balls go. */
struct Walk {
    DoubleRow end, back;  // [cells] the ray's end, and the unit vector towards the origin
    double length;        // [cells]
    double slope, start;  // a ball t cells from the end has the radius slope * (t - start), up to R
};

AKIMAP_INLINE Walk walkOf(const Ray& r, double per_cell, double slope, double start) {
    double back[3];
    for (std::size_t i = 0; i < 3; i++) back[i] = r.origin[i] - r.end[i];
    const double length = std::hypot(back[0], back[1], back[2]);
    for (double& b : back) b /= length;
    const DoubleRow end = DoubleRow{r.end[0], r.end[1], r.end[2]} * per_cell;
    return {end, DoubleRow{back[0], back[1], back[2]}, length * per_cell, slope, start};
}

/** From a hit, whose plane the balls hardly cross. */
AKIMAP_INLINE Walk walkFrom(const Ray& r, const HitPlane& s, double per_cell) {
    Walk w = walkOf(r, per_cell, kClearance, 0);
    if (s.flat)
        w.slope *= std::abs(w.back[0] * static_cast<double>(s.normal[0]) +
                            w.back[1] * static_cast<double>(s.normal[1]) +
                            w.back[2] * static_cast<double>(s.normal[2]));
    return w;
}

/** The cell at this way from the hit [cells]. */
AKIMAP_INLINE CellIndex cellOn(const Walk& w, double t, const CellIndex& anchor) {
    using Whole = int32_t __attribute__((vector_size(16)));
    const DoubleRow at = w.end + w.back * t;
    Whole cell = __builtin_convertvector(at, Whole);  // towards zero
    cell += __builtin_convertvector(at < __builtin_convertvector(cell, DoubleRow), Whole);
    return {cell[0] - anchor.x, cell[1] - anchor.y, cell[2] - anchor.z};
}

/** Marks the balls along a ray, R = radius [cells]. \return number of balls */
AKIMAP_INLINE std::size_t markRay(const Walk& w, double radius, const CellIndex& anchor,
                                  FreeBalls& free) {
    std::size_t balls = 0;
    double t = 1;
    for (double ball; t < w.length && (ball = w.slope * (t - w.start)) < radius;
         t += std::max(1.0, kStep * ball)) {
        if (ball < kLeastBall) continue;
        balls++;
        free.mark(cellOn(w, t, anchor),
                  static_cast<uint16_t>(kPowerUnit * (radius * radius - ball * ball)));
    }
    const double step = std::max(1.0, kStep * radius);
    for (; t < w.length; t += step, balls++) free.mark(cellOn(w, t, anchor), 0);
    return balls;
}

AKIMAP_MULTIVERSION
std::size_t markRange(const KeptRay* rays, const HitPlane* planes, std::size_t n, double radius,
                      double per_cell, const CellIndex& anchor, FreeBalls& free) {
    std::size_t balls = 0;
    for (std::size_t i = 0; i < n; i++)
        balls += markRay(walkFrom(*rays[i].ray, planes[i], per_cell), radius, anchor, free);
    return balls;
}

}  // namespace

std::size_t markHitRays(const std::vector<KeptRay>& rays, const std::vector<HitPlane>& planes,
                        double radius, double resolution, const CellIndex& anchor,
                        std::vector<FreeBalls>& parts, FreeBalls& free) {
    constexpr std::size_t kFewest = 1000;  // rays of a part
    const auto threads = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
    const std::size_t n = std::clamp(rays.size() / kFewest, std::size_t{1}, threads);
    parts.resize(std::max(parts.size(), n));
    std::atomic<std::size_t> balls{0};
    tbb::parallel_for(std::size_t{0}, n, [&](std::size_t p) {
        const std::size_t begin = rays.size() * p / n, end = rays.size() * (p + 1) / n;
        FreeBalls& part = p == 0 ? free : parts[p];
        part.clear();
        balls += markRange(rays.data() + begin, planes.data() + begin, end - begin, radius,
                           1 / resolution, anchor, part);
    });
    for (std::size_t p = 1; p < n; p++) free.merge(parts[p]);
    return balls;
}

std::size_t markBeams(const std::vector<Ray>& beams, double radius, double resolution,
                      const CellIndex& anchor, FreeBalls& free) {
    std::size_t balls = 0;
    for (const Ray& r : beams)
        balls += markRay(walkOf(r, 1 / resolution, 1, kOffCenter), radius, anchor, free);
    return balls;
}

}  // namespace akimap
