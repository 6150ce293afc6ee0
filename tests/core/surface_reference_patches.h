// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

// Steps 1 to 3 of surface_reference.h: from rays to what a scan's surfaces say of cells.

#include <akimap/Parameters.h>
#include <akimap/Ray.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <vector>

namespace akimap::reference::surface {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Cell = std::array<int, 3>;   // x, y, z
using Block = std::array<int, 3>;  // of 8^3 cells

// All lengths are in cells, in the map's frame: the centre of cell i is at i + 0.5.

inline Vector3d centerOf(const Cell& c) {
    return {c[0] + 0.5, c[1] + 0.5, c[2] + 0.5};
}
inline Cell cellAt(const Vector3d& p) {
    const auto floor = [](double v) { return static_cast<int>(std::floor(v)); };
    return {floor(p[0]), floor(p[1]), floor(p[2])};
}
inline Block blockOf(const Cell& c) {
    return {c[0] >> 3, c[1] >> 3, c[2] >> 3};
}
/** Calls visit(cell) for the cells, or blocks, from one corner to the other, both included. */
template <class Visit>
void forEachBetween(const Cell& first, const Cell& last, Visit&& visit) {
    for (int z = first[2]; z <= last[2]; z++)
        for (int y = first[1]; y <= last[1]; y++)
            for (int x = first[0]; x <= last[0]; x++) visit(Cell{x, y, z});
}

// 1. Hits: at most one a cell, and the beams that met nothing, at most one an end's cell.

struct Line {
    Vector3d origin, end;
    int returns = 1;
    [[nodiscard]] double length() const { return (origin - end).norm(); }
    [[nodiscard]] Vector3d back() const { return (origin - end).normalized(); }
};
struct Lines {
    std::vector<Line> hits, beams;
};

inline Lines linesOf(const std::vector<Ray>& rays, const ScanParameters& p, double resolution) {
    Lines lines;
    std::map<Cell, std::size_t> hit_in;
    std::set<Cell> beam_to;
    for (const Ray& r : rays) {
        const double length = lengthOf(r);
        const Vector3d origin = Vector3d(r.origin.data()) / resolution,
                       end = Vector3d(r.end.data()) / resolution;
        if (r.hit && p.takesLength(length)) {
            const auto [hit, is_new] = hit_in.emplace(cellAt(end), lines.hits.size());
            if (is_new)
                lines.hits.push_back({origin, end});
            else
                lines.hits[hit->second].returns++;
        } else if (p.beyond_max_range == BeyondMaxRange::free &&
                   (p.takesLength(length) || length >= p.max_range)) {
            const Vector3d cut = origin + (end - origin) * std::min(1.0, p.max_range / length);
            if (beam_to.insert(cellAt(cut)).second) lines.beams.push_back({origin, cut});
        }
    }
    return lines;
}

// 2. Patches.

struct Patch {
    Vector3d place, normal, u, v;  ///< the axes u and v are divided by the ellipse's semi-axes
    Cell cell;                     ///< of the hit
    int returns;
};

struct Neighborhood {
    int n = 0;
    Vector3d mean = Vector3d::Zero();  ///< relative to the hit
    Vector3d variance;                 ///< in increasing order
    Matrix3d axes;
};

inline Neighborhood neighborhoodOf(const std::vector<Line>& hits, const Vector3d& hit,
                                   double range) {
    std::vector<Vector3d> near;
    double radius = std::min(2.5, range);
    for (;; radius = std::min(1.3 * radius, range)) {
        near.clear();
        for (const Line& other : hits)
            if ((other.end - hit).norm() <= radius) near.push_back(other.end - hit);
        if (near.size() >= 10 || radius >= range) break;
    }
    Neighborhood found;
    found.n = static_cast<int>(near.size());
    const auto weight = [&](const Vector3d& d) {
        return 1 - d.squaredNorm() / (2 * radius * radius);
    };
    double sum = 0;
    for (const Vector3d& d : near) sum += weight(d), found.mean += weight(d) * d;
    found.mean /= sum;
    Matrix3d covariance = Matrix3d::Zero();
    for (const Vector3d& d : near)
        covariance += weight(d) / sum * (d - found.mean) * (d - found.mean).transpose();
    covariance *= found.n / std::max(1.0, found.n - 1.0);
    const Eigen::SelfAdjointEigenSolver<Matrix3d> eigen(covariance);
    found.variance = eigen.eigenvalues().cwiseMax(0);
    found.axes = eigen.eigenvectors();
    return found;
}

/** An ellipse with semi-axis a as nearly along `along` as its plane has it, and b across. */
inline Patch ellipse(const Vector3d& place, const Vector3d& normal, const Vector3d& along, double a,
                     double b) {
    Vector3d u = along - normal * normal.dot(along);
    u = u.norm() > 1e-6 ? u.normalized() : normal.unitOrthogonal();
    return {place, normal, u / a, normal.cross(u) / b, {}, 0};
}

inline Patch shapeOf(const Line& hit, const Neighborhood& near, double widest) {
    constexpr double kAlone = 1.2, kNarrowest = 0.8;
    const Vector3d back = hit.back();
    const auto semiAxis = [&](int axis, double least) {
        return std::clamp(2 * std::sqrt(near.variance[axis]), least, widest);
    };
    if (near.n >= 3 && near.variance[1] < 0.005 * near.variance[2]) {
        const Vector3d line = near.axes.col(2), across = back - line * line.dot(back);
        const Vector3d normal = across.norm() < 0.1 ? back : across.normalized();
        return ellipse(hit.end, normal, line, semiAxis(2, kAlone), kAlone);
    }
    const Vector3d axis = near.axes.col(0), normal = axis.dot(back) < 0 ? Vector3d(-axis) : axis;
    if (near.n >= 5 && near.variance[0] < 0.05 * near.variance[1] && normal.dot(back) > 0.15)
        return ellipse(hit.end + normal * normal.dot(near.mean), normal, near.axes.col(2),
                       semiAxis(2, kNarrowest), semiAxis(1, kNarrowest));
    return ellipse(hit.end, back, Vector3d::Zero(), kAlone, kAlone);
}

inline std::vector<Patch> patchesOf(const std::vector<Line>& hits, const SurfaceParameters& p,
                                    double resolution) {
    const double range = std::max(p.surface_range / resolution, 1.0),
                 widest = std::max(0.24 / resolution, 1.2);
    std::vector<Patch> patches;
    for (const Line& hit : hits) {
        patches.push_back(shapeOf(hit, neighborhoodOf(hits, hit.end, range), widest));
        patches.back().cell = cellAt(hit.end), patches.back().returns = hit.returns;
    }
    return patches;
}

// 3. What the patches say of cells.

constexpr double kFront = 2, kBehind = 3;

struct Measured {
    double weight = 0, place = 0;  ///< sums of w and of w d
    int returns = 0;
};
struct Surfaces {
    std::map<Cell, Measured> cells;
    std::set<Block> blocks;  ///< that a patch's box meets
};

/** The box of the cells that a patch may reach, and its hit's cell. */
inline std::pair<Cell, Cell> boxOf(const Patch& p) {
    std::pair<Cell, Cell> box;
    for (std::size_t a = 0; a < 3; a++) {
        const auto i = static_cast<Eigen::Index>(a);
        const double along = std::hypot(p.u[i] / p.u.squaredNorm(), p.v[i] / p.v.squaredNorm()),
                     n = p.normal[i],
                     first = p.place[i] - along + std::min(-kBehind * n, kFront * n),
                     last = p.place[i] + along + std::max(-kBehind * n, kFront * n);
        box.first[a] = std::min(static_cast<int>(std::ceil(first - 0.5)), p.cell[a]);
        box.second[a] = std::max(static_cast<int>(std::floor(last - 0.5)), p.cell[a]);
    }
    return box;
}

inline Surfaces surfacesOf(const std::vector<Patch>& patches) {
    Surfaces s;
    for (const Patch& p : patches) {
        const auto [first, last] = boxOf(p);
        forEachBetween(blockOf(first), blockOf(last), [&](const Block& b) { s.blocks.insert(b); });
        forEachBetween(first, last, [&](const Cell& c) {
            const Vector3d from = centerOf(c) - p.place;
            const double d = p.normal.dot(from),
                         q = std::pow(p.u.dot(from), 2) + std::pow(p.v.dot(from), 2);
            if (q >= 1 || d >= kFront || d <= -kBehind) return;
            const double w = std::pow(1 - 0.64 * q, 4) * std::min(1.0, 1 + d / kBehind);
            s.cells[c].weight += w, s.cells[c].place += w * d;
        });
        s.cells[p.cell].returns += p.returns;
    }
    return s;
}

}  // namespace akimap::reference::surface
