// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

// Step 4 of surface_reference.h: where a scan's rays passed, and what lies between them.

#include "surface_reference_patches.h"

namespace akimap::reference::surface {

constexpr int kPowerUnit = 64, kFar = 1 << 20;  // power distances are whole numbers of 1/64 cell^2
constexpr int kMostPasses = 255;

struct Passed {
    int power = kFar;  ///< least R^2 - rho^2 of the balls around this cell
    int passes = 0;    ///< returns whose rays passed
};
using Marks = std::map<Cell, Passed>;

/** How the balls along a line grow, from its end. */
struct Growth {
    double slope, start;  ///< rho = slope (t - start) at t from the end, at most R
    double passes;        ///< the ray has passed what lies so far before its end
};

/** Where the line crosses from cell to cell, from 0 to its length. */
inline std::vector<double> crossingsOf(const Line& line) {
    std::vector<double> t{0, line.length()};
    const Vector3d back = line.back();
    for (int a = 0; a < 3; a++) {
        const auto [low, high] = std::minmax(line.end[a], line.origin[a]);
        for (double plane = std::ceil(low); plane <= high; plane++)
            if (back[a] != 0) t.push_back((plane - line.end[a]) / back[a]);
    }
    std::sort(t.begin(), t.end());
    return t;
}

/** Blocks near surfaces. */
struct NearBlocks {
    const std::set<Block>& of_map;   ///< whose cells know each ray that passes
    const std::set<Block>& of_scan;  ///< in which rays have balls in each cell, too
};

/** Cell by cell in blocks near surfaces, elsewhere at places half of R apart. */
inline void mark(const Line& line, const Growth& g, double radius, const NearBlocks& near,
                 Marks& marks) {
    const Vector3d back = line.back();
    const auto markAt = [&](double t, bool in_each_cell) {
        const Cell c = cellAt(line.end + back * t);
        const Block b = blockOf(c);
        const bool has_balls = near.of_scan.count(b),
                   knows_passes = has_balls || near.of_map.count(b);
        const double ball = std::min(g.slope * (t - g.start), radius);
        if (has_balls == in_each_cell && ball >= 0.25) {
            int& power = marks[c].power;
            power = std::min(power, static_cast<int>(kPowerUnit * (radius * radius - ball * ball)));
        }
        if (knows_passes == in_each_cell && t >= g.passes) {
            int& passes = marks[c].passes;
            passes = std::min(kMostPasses, passes + line.returns);
        }
    };
    const std::vector<double> crossings = crossingsOf(line);
    for (std::size_t i = 1; i < crossings.size(); i++)
        if (crossings[i] > crossings[i - 1] + 1e-6)
            markAt((crossings[i - 1] + crossings[i]) / 2, true);
    const double step = std::max(1.0, radius / 2);
    for (double t = 0; t < line.length(); t += step) markAt(t, false);
}

inline Marks marksOf(const Lines& lines, const std::vector<Patch>& patches, double radius,
                     const NearBlocks& near) {
    Marks marks;
    for (std::size_t i = 0; i < patches.size(); i++) {
        const double cosine = std::max(std::abs(lines.hits[i].back().dot(patches[i].normal)), 0.05);
        mark(lines.hits[i], {1.5 * cosine, 0, 1.5 / cosine}, radius, near, marks);
    }
    for (const Line& beam : lines.beams) mark(beam, {1, 0.9, 0.9}, radius, near, marks);
    return marks;
}

/** b of the cells in the balls: 1 on a ray, 0 as far from it as free space reaches. */
inline std::map<Cell, double> nearnessOf(const Marks& marks, double radius) {
    std::map<Cell, int> power;
    const int reach = static_cast<int>(std::ceil(radius));
    const double limit = kPowerUnit * radius * radius;
    for (const auto& [ball, mark] : marks)
        forEachBetween({-reach, -reach, -reach}, {reach, reach, reach}, [&](const Cell& d) {
            const int p = mark.power + kPowerUnit * (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
            if (p >= limit) return;
            int& least = power.try_emplace({ball[0] + d[0], ball[1] + d[1], ball[2] + d[2]}, kFar)
                             .first->second;
            least = std::min(least, p);
        });
    std::map<Cell, double> near;
    for (const auto& [cell, p] : power) near[cell] = 1 - p / limit;
    return near;
}

}  // namespace akimap::reference::surface
