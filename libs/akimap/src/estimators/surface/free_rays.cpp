// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
// Compiled without fused multiply-adds (see CMakeLists.txt): a rounded place decides on a cell.
#include "estimators/surface/free_rays.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>

#include "numeric/rows.h"

namespace akimap {
namespace {
constexpr double kClearance = 1.5;  // a ball's radius over its distance from the hit's plane, and
                                    // [cells] from it: there a ray has passed
constexpr double kStep = 0.5;       // from ball to ball, over R
constexpr double kLeastCosine = 0.05;  // of the angle between a plane's normal and a ray
constexpr double kLeastBall = 0.25;    // [cells]
constexpr double kOffCenter = 0.9;  // [cells] balls are centred on cells: half a diagonal, rounding
constexpr double kShortest = 1e-6;  // [cells] what a ray crosses on a shorter way it only touches

/** Of a ray, away from its end: where balls go. Lengths in cells, places relative to the anchor. */
struct Walk {
    double end[3], back[3];  // the ray's end, and the unit vector towards the origin
    double per_back[3];      // 1 / back; huge where it is 0
    double length;
    double slope, start;  // a ball t cells from the end has the radius slope * (t - start), up to R
    double passes;        // from the end: the ray has passed what lies before
};

AKIMAP_INLINE Walk walkOf(const Ray& r, const RayMarking& m, double slope, double start) {
    Walk w{};
    const double lowest[3] = {static_cast<double>(m.anchor.x), static_cast<double>(m.anchor.y),
                              static_cast<double>(m.anchor.z)};
    for (std::size_t i = 0; i < 3; i++) w.back[i] = r.origin[i] - r.end[i];
    const double length =
        std::sqrt(w.back[0] * w.back[0] + w.back[1] * w.back[1] + w.back[2] * w.back[2]);
    for (std::size_t i = 0; i < 3; i++) {
        w.back[i] /= length;
        w.per_back[i] = 1 / (std::abs(w.back[i]) > 1e-12 ? w.back[i] : 1e-12);
        w.end[i] = r.end[i] / m.resolution - lowest[i];
    }
    w.length = length / m.resolution;
    w.slope = slope, w.start = w.passes = start;
    return w;
}

/** From a hit, whose plane the balls hardly cross. */
AKIMAP_INLINE Walk walkFrom(const Ray& r, const Patch& p, const RayMarking& m) {
    Walk w = walkOf(r, m, 0, 0);
    const double cosine = std::abs(w.back[0] * static_cast<double>(p.normal[0]) +
                                   w.back[1] * static_cast<double>(p.normal[1]) +
                                   w.back[2] * static_cast<double>(p.normal[2]));
    w.slope = kClearance * std::max(cosine, kLeastCosine);
    w.passes = kClearance / std::max(cosine, kLeastCosine);
    return w;
}

/** Calls visit(box, enter, leave) for the boxes of this side [cells] along a part of a ray, in
 * order. (Amanatides and Woo 1987.) */
template <class Visit>
AKIMAP_INLINE void walkBoxes(const Walk& w, double side, double from, double to, Visit&& visit) {
    int32_t box[3], step[3];
    double next[3], stride[3];
    for (int a = 0; a < 3; a++) {
        const double at = w.end[a] + w.back[a] * from;
        box[a] = static_cast<int32_t>(std::floor(at / side));
        const bool up = w.per_back[a] > 0;
        step[a] = up ? 1 : -1;
        stride[a] = side * std::abs(w.per_back[a]);
        next[a] = ((box[a] + up) * side - w.end[a]) * w.per_back[a];
    }
    for (double t = from; t < to;) {
        const int a =
            next[0] <= next[1] ? (next[0] <= next[2] ? 0 : 2) : (next[1] <= next[2] ? 1 : 2);
        const double leave = std::min(next[a], to);
        if (leave > t + kShortest) visit(CellIndex{box[0], box[1], box[2]}, t, leave);
        t = next[a];
        next[a] += stride[a];
        box[a] += step[a];
    }
}

/** Marks a place of a ray, a block's cell. */
AKIMAP_INLINE void markBall(const Walk& w, double t, double radius, int cell,
                            FreeBalls::Marks marks) {
    const double ball = std::min(w.slope * (t - w.start), radius);
    if (ball < kLeastBall) return;
    marks.ball(cell, static_cast<uint16_t>(kPowerUnit * (radius * radius - ball * ball)));
}
AKIMAP_INLINE void markPass(const Walk& w, double t, unsigned returns, int cell,
                            FreeBalls::Marks marks) {
    if (t >= w.passes) marks.pass(cell, returns);
}

/** The cell of a block at a place of a ray, which rounding may put beside it. */
AKIMAP_INLINE int cellIn(const CellIndex& block, const CellIndex& c) {
    const auto inside = [](int32_t v) { return std::clamp(v, 0, Block::kSide - 1); };
    return Block::offset(inside(c.x - block.x * Block::kSide), inside(c.y - block.y * Block::kSide),
                         inside(c.z - block.z * Block::kSide));
}
AKIMAP_INLINE CellIndex cellOn(const Walk& w, double t) {
    const auto at = [&](int a) {
        return static_cast<int32_t>(std::floor(w.end[a] + w.back[a] * t));
    };
    return {at(0), at(1), at(2)};
}

/** What of a ray lies in a block. */
struct RayPart {
    FreeBalls& free;
    uint32_t number;  // of the block
    CellIndex block;
    double enter, leave;  // from the ray's end
    unsigned returns;     // that the ray stands for
    [[nodiscard]] AKIMAP_INLINE FreeBalls::Marks marks() const { return free.marksOf(number); }
};

/** Marks the cells of a part that lies far from its ray's hit: all alike. */
template <bool kBalls>
AKIMAP_INLINE void markFar(const Walk& w, const RayPart& part) {
    FreeBalls::Marks marks = part.marks();
    const CellIndex& b = part.block;
    const int32_t low[3] = {b.x * Block::kSide, b.y * Block::kSide, b.z * Block::kSide};
    double next[3], stride[3];
    int step[3], cell = 0;
    for (int a = 0; a < 3; a++) {
        const double at = w.end[a] + w.back[a] * part.enter - low[a];
        const int first = std::clamp(static_cast<int>(at), 0, Block::kSide - 1);
        const bool up = w.per_back[a] > 0;
        cell |= first << 3 * a, step[a] = (up ? 1 : -1) * (1 << 3 * a);
        stride[a] = std::abs(w.per_back[a]);
        next[a] = (low[a] + first + up - w.end[a]) * w.per_back[a];
    }
    for (;;) {  // without branches: each axis is as likely as the others
        if constexpr (kBalls) marks.ball(cell, 0);
        marks.pass(cell, part.returns);
        const double t = std::min(next[0], std::min(next[1], next[2]));
        if (t > part.leave - kShortest) return;  // nor may rounding lead out of the block
        const bool x = next[0] == t, y = !x && next[1] == t, z = !x && !y;
        cell = (cell + (x ? step[0] : y ? step[1] : step[2])) & (Block::kCells - 1);
        next[0] += x ? stride[0] : 0, next[1] += y ? stride[1] : 0, next[2] += z ? stride[2] : 0;
    }
}

/** Marks each cell of a part. \param far from the ray's end, all cells are alike */
template <bool kBalls>
AKIMAP_INLINE void markCells(const Walk& w, const RayPart& part, double radius, double far) {
    if (part.enter >= far) return markFar<kBalls>(w, part);
    walkBoxes(w, 1, part.enter, part.leave,
              [&](const CellIndex& c, double enter, double leave) AKIMAP_INLINE_LAMBDA {
                  const double t = 0.5 * (enter + leave);
                  const int cell = cellIn(part.block, c);
                  const FreeBalls::Marks marks = part.marks();
                  if constexpr (kBalls) markBall(w, t, radius, cell, marks);
                  markPass(w, t, part.returns, cell, marks);
              });
}

/** Marks places of a part that lie a step apart. */
AKIMAP_INLINE void markSteps(const Walk& w, const RayPart& part, double radius, bool passes) {
    const double step = std::max(1.0, kStep * radius);
    for (double t = std::ceil(part.enter / step) * step; t < part.leave; t += step) {
        const int cell = cellIn(part.block, cellOn(w, t));
        const FreeBalls::Marks marks = part.marks();
        markBall(w, t, radius, cell, marks);
        if (passes) markPass(w, t, part.returns, cell, marks);
    }
}

/** Marks a ray block by block. \param returns that the ray stands for */
AKIMAP_INLINE void markRay(const Walk& w, const RayMarking& m, unsigned returns, FreeBalls& free) {
    const double far = std::max(w.passes, w.start + m.radius / w.slope);
    const auto markingOf = [&](uint64_t key) { return m.of(key); };
    walkBoxes(w, Block::kSide, 0, w.length,
              [&](const CellIndex& b, double enter, double leave) AKIMAP_INLINE_LAMBDA {
                  const uint32_t number = free.numberOf(packKey(b), markingOf);
                  const RayPart part{free, number, b, enter, leave, returns};
                  const Marking marking = free.markingOf(number);
                  if (marking == Marking::cells) return markCells<true>(w, part, m.radius, far);
                  markSteps(w, part, m.radius, marking == Marking::steps);
                  if (marking == Marking::passes) markCells<false>(w, part, m.radius, far);
              });
}

AKIMAP_MULTIVERSION
void markRange(const RayMarking& m, const KeptRay* rays, const Patch* patches, std::size_t n,
               FreeBalls& free) {
    for (std::size_t i = 0; i < n; i++)
        markRay(walkFrom(*rays[i].ray, patches[i], m), m, rays[i].returns, free);
}

}  // namespace

Marking RayMarking::of(uint64_t block_key) const {
    if (patches.numbers.find(block_key) != KeyTable::kNone) return Marking::cells;
    const Block* block = grid.find(blockInMap(block_key, anchor));
    return block && block->surface ? Marking::passes : Marking::steps;
}

void markHitRays(const RayMarking& m, const std::vector<KeptRay>& rays,
                 std::vector<FreeBalls>& parts, FreeBalls& free) {
    constexpr std::size_t kFewest = 1000;  // rays of a part
    const auto threads = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
    const std::size_t n = std::clamp(rays.size() / kFewest, std::size_t{1}, threads);
    parts.resize(std::max(parts.size(), n));
    tbb::parallel_for(std::size_t{0}, n, [&](std::size_t p) {
        const std::size_t begin = rays.size() * p / n, end = rays.size() * (p + 1) / n;
        FreeBalls& part = p == 0 ? free : parts[p];
        part.clear();
        markRange(m, rays.data() + begin, m.patches.patches.data() + begin, end - begin, part);
    });
    for (std::size_t p = 1; p < n; p++) free.merge(parts[p]);
}

void markBeams(const RayMarking& m, const std::vector<Ray>& beams, FreeBalls& free) {
    for (const Ray& r : beams) markRay(walkOf(r, m, 1, kOffCenter), m, 1, free);
}

}  // namespace akimap
