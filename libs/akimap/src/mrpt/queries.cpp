// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <akimap/queries.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <unsupported/Eigen/SpecialFunctions>

namespace akimap {
namespace {

using mrpt::math::TPoint3D;
using mrpt::math::TVector3D;

void require(bool ok, const char* what) {
    if (!ok) throw std::invalid_argument(what);
}
bool isFinite(const TPoint3D& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}
void requireThreshold(double threshold) {
    require(threshold > 0 && threshold < 1, "threshold: must be in (0, 1)");
}

TPoint3D centerOf(const AkiMap& map, const CellIndex& c) {
    const BlockGrid& grid = map.grid();
    return {grid.center(c.x), grid.center(c.y), grid.center(c.z)};
}
std::optional<CellState> cellOf(const AkiMap& map, const TPoint3D& p) {
    return map.cell(p.x, p.y, p.z);
}

void doubt(Doubt& least_sure, const TPoint3D& place, double confidence) {
    if (confidence < least_sure.confidence) least_sure = {place, confidence};
}

/** Steps from cell to cell along a ray. */
class CellWalk {
 public:
    CellWalk(const BlockGrid& grid, const TPoint3D& origin, const TVector3D& unit)
        : cell_(grid.cellAt(origin.x, origin.y, origin.z)) {
        for (std::size_t i = 0; i < 3; i++) {
            const double o = origin[i], d = unit[i], r = grid.resolution();
            step_[i] = d > 0 ? 1 : -1;
            if (d == 0) continue;  // it never leaves that layer
            across_[i] = r / std::abs(d);
            next_[i] = ((index(i) + (d > 0 ? 1 : 0)) * r - o) / d;
        }
    }
    [[nodiscard]] const CellIndex& cell() const { return cell_; }
    [[nodiscard]] double entered() const { return entered_; }  ///< [m] from the origin
    [[nodiscard]] double left() const { return *std::min_element(next_.begin(), next_.end()); }
    void advance() {
        const auto axis =
            static_cast<std::size_t>(std::min_element(next_.begin(), next_.end()) - next_.begin());
        entered_ = next_[axis];
        next_[axis] += across_[axis];
        index(axis) += step_[axis];
    }

 private:
    int32_t& index(std::size_t axis) { return axis == 0 ? cell_.x : axis == 1 ? cell_.y : cell_.z; }
    static constexpr double kNever = std::numeric_limits<double>::infinity();
    CellIndex cell_;
    std::array<int32_t, 3> step_{};
    std::array<double, 3> next_{kNever, kNever, kNever}, across_{kNever, kNever, kNever};
    double entered_ = 0;
};

double distanceToPiece(const TPoint3D& p, const TPoint3D& a, const TPoint3D& b) {
    const TVector3D along = b - a;
    const double length2 = along.sqrNorm();
    const TVector3D to = p - a;
    const double dot = to.x * along.x + to.y * along.y + to.z * along.z;
    const double t = length2 > 0 ? std::clamp(dot / length2, 0.0, 1.0) : 0;
    return (p - (a + along * t)).norm();
}

}  // namespace

CellKind kindOf(const std::optional<CellState>& cell) {
    if (!cell) return CellKind::unknown;
    if (cell->alpha > 3 * cell->beta) return CellKind::occupied;
    if (cell->beta > 3 * cell->alpha) return CellKind::free;
    return CellKind::conflicting;
}

double probabilityAbove(const CellState& cell, double threshold) {
    requireThreshold(threshold);
    return 1 - Eigen::numext::betainc(cell.alpha, cell.beta, threshold);
}

double confidenceInFree(const std::optional<CellState>& cell, double threshold) {
    return cell ? 1 - probabilityAbove(*cell, threshold) : 0.5;
}

RayCast castRay(const AkiMap& map, const TPoint3D& origin, const TVector3D& direction,
                double max_range, double threshold) {
    requireThreshold(threshold);
    require(isFinite(origin) && isFinite(direction) && direction.norm() > 0,
            "ray: must be finite, its direction not zero");
    require(std::isfinite(max_range) && max_range >= 0, "max_range: must be finite and >= 0");
    RayCast cast{std::nullopt, {origin, 1}};
    const TVector3D unit = direction * (1 / direction.norm());
    require(map.grid().hasCell(origin.x, origin.y, origin.z), "ray: it begins outside the grid");
    for (CellWalk walk(map.grid(), origin, unit); walk.entered() <= max_range; walk.advance()) {
        const TPoint3D middle = origin + unit * ((walk.entered() + walk.left()) / 2);
        if (!map.grid().hasCell(middle.x, middle.y, middle.z)) break;
        const auto cell = cellOf(map, centerOf(map, walk.cell()));
        if (cell && cell->occupancy() > threshold) {
            cast.hit = walk.entered();
            break;
        }
        doubt(cast.least_sure, middle, confidenceInFree(cell, threshold));
    }
    return cast;
}

SweptPath sweepSphere(const AkiMap& map, const std::vector<TPoint3D>& path, double radius,
                      double threshold) {
    requireThreshold(threshold);
    require(!path.empty() && std::all_of(path.begin(), path.end(), isFinite),
            "path: must have places, all finite");
    require(std::isfinite(radius) && radius >= 0, "radius: must be finite and >= 0");
    const BlockGrid& grid = map.grid();
    for (const TPoint3D& p : path)
        require(grid.hasCell(p.x - radius, p.y - radius, p.z - radius) &&
                    grid.hasCell(p.x + radius, p.y + radius, p.z + radius),
                "path: it leaves the grid");
    SweptPath swept{std::nullopt, {path.front(), 1}};
    // A cell is touched if its own sphere is: half a diagonal more than enough, never too little.
    const double reach = radius + std::sqrt(0.75) * grid.resolution();
    const auto look = [&](const TPoint3D& a, const TPoint3D& b) {
        const CellIndex low = grid.cellAt(std::min(a.x, b.x) - radius, std::min(a.y, b.y) - radius,
                                          std::min(a.z, b.z) - radius);
        const CellIndex high = grid.cellAt(std::max(a.x, b.x) + radius, std::max(a.y, b.y) + radius,
                                           std::max(a.z, b.z) + radius);
        for (int32_t z = low.z; z <= high.z; z++)
            for (int32_t y = low.y; y <= high.y; y++)
                for (int32_t x = low.x; x <= high.x; x++) {
                    const TPoint3D center = centerOf(map, {x, y, z});
                    if (distanceToPiece(center, a, b) > reach) continue;
                    const auto cell = cellOf(map, center);
                    if (!swept.collision && cell && cell->occupancy() > threshold)
                        swept.collision = center;
                    doubt(swept.least_sure, center, confidenceInFree(cell, threshold));
                }
    };
    look(path.front(), path.front());
    for (std::size_t i = 1; i < path.size(); i++) {
        const TVector3D way = path[i] - path[i - 1];  // in steps, so that boxes stay small
        const double steps = std::ceil(way.norm() / std::max(radius, 4 * grid.resolution()));
        for (double k = 0; k < steps; k++)
            look(path[i - 1] + way * (k / steps), path[i - 1] + way * ((k + 1) / steps));
    }
    return swept;
}

std::optional<SurfaceNormal> surfaceNormal(const AkiMap& map, double x, double y, double z) {
    constexpr int kReach = 2;
    const double r = map.resolution();
    double weight = 0;
    Eigen::Vector3d mean(0, 0, 0), freer(0, 0, 0);
    Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
    for (int k = -kReach; k <= kReach; k++)
        for (int j = -kReach; j <= kReach; j++)
            for (int i = -kReach; i <= kReach; i++) {
                const auto cell = map.cell(x + i * r, y + j * r, z + k * r);
                if (!cell) continue;
                const Eigen::Vector3d d(i, j, k);
                const double p = cell->occupancy();
                freer += (1 - p) * d;
                if (p <= 0.5) continue;
                weight += p, mean += p * d, moments += p * d * d.transpose();
            }
    if (weight < 3) return std::nullopt;
    mean /= weight;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(moments / weight -
                                                              mean * mean.transpose());
    const Eigen::Vector3d& extents = axes.eigenvalues();  // ascending
    if (!(extents[1] > 0)) return std::nullopt;
    Eigen::Vector3d n = axes.eigenvectors().col(0);
    if (n.dot(freer) < 0) n = -n;
    return SurfaceNormal{{n[0], n[1], n[2]}, 1 - std::sqrt(std::max(0.0, extents[0]) / extents[1])};
}

}  // namespace akimap
