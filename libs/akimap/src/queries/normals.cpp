// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "queries/normals.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace akimap {
namespace {

/** Or may be, where distances are not known. \pre the place has a cell */
bool isOnSurface(const MapView& map, double x, double y, double z) {
    const auto d = map.surfaceDistance(map.grid.cellAt(x, y, z));
    return !d || std::abs(*d) <= kOnSurface;
}

}  // namespace

std::optional<CellNormal> normalAt(const MapView& map, double x, double y, double z) {
    constexpr int kReach = 2;
    const double r = map.grid.resolution();
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
                if (p <= 0.5 || !isOnSurface(map, x + i * r, y + j * r, z + k * r)) continue;
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
    return CellNormal{n, 1 - std::sqrt(std::max(0.0, extents[0]) / extents[1])};
}

}  // namespace akimap
