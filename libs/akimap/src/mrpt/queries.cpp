// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <akimap/queries.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "mrpt/Impl.h"
#include "queries/CellWalk.h"
#include "queries/SweptSphere.h"
#include "queries/normals.h"

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
Eigen::Vector3d toEigen(const TPoint3D& p) {
    return {p.x, p.y, p.z};
}
TPoint3D toMrpt(const Eigen::Vector3d& p) {
    return {p.x(), p.y(), p.z()};
}

void lower(FreeConfidence& least_sure, const TPoint3D& place, double confidence) {
    if (confidence < least_sure.confidence) least_sure = {place, confidence};
}

}  // namespace

RayCast castRay(const AkiMap& map, const TPoint3D& origin, const TVector3D& direction,
                double max_range, double threshold) {
    requireThreshold(threshold);
    require(isFinite(origin) && std::isfinite(direction.norm()) && direction.norm() > 0,
            "ray: must be finite, its direction not zero");
    require(std::isfinite(max_range) && max_range >= 0, "max_range: must be finite and >= 0");
    const MapView view = viewOf(map);
    require(view.grid.hasCell(origin.x, origin.y, origin.z), "ray: it begins outside the grid");
    RayCast cast{std::nullopt, {origin, 1}};
    const TVector3D unit = direction * (1 / direction.norm());
    for (CellWalk walk(view.grid, toEigen(origin), toEigen(unit)); walk.entered() <= max_range;
         walk.advance()) {
        const TPoint3D middle = origin + unit * ((walk.entered() + walk.left()) / 2);
        if (!view.grid.hasCell(middle.x, middle.y, middle.z)) break;
        const auto cell = view.cell(walk.cell());
        if (cell && cell->occupancy() > threshold) {
            cast.hit = walk.entered();
            break;
        }
        lower(cast.least_sure, middle, confidenceInFree(cell, threshold));
    }
    return cast;
}

SweptPath sweepSphere(const AkiMap& map, const std::vector<TPoint3D>& path, double radius,
                      double threshold) {
    requireThreshold(threshold);
    require(!path.empty() && std::all_of(path.begin(), path.end(), isFinite),
            "path: must have places, all finite");
    require(std::isfinite(radius) && radius >= 0, "radius: must be finite and >= 0");
    const MapView view = viewOf(map);
    std::vector<Eigen::Vector3d> places;
    for (const TPoint3D& p : path) {
        require(view.grid.hasCell(p.x - radius, p.y - radius, p.z - radius) &&
                    view.grid.hasCell(p.x + radius, p.y + radius, p.z + radius),
                "path: it leaves the grid");
        places.push_back(toEigen(p));
    }
    SweptPath swept{std::nullopt, {path.front(), 1}};
    SweptSphere(view.grid, radius)
        .forEachCell(places, [&](const CellIndex& c, const Eigen::Vector3d& center) {
            const auto cell = view.cell(c);
            if (!swept.collision && cell && cell->occupancy() > threshold)
                swept.collision = toMrpt(center);
            lower(swept.least_sure, toMrpt(center), confidenceInFree(cell, threshold));
        });
    return swept;
}

std::optional<SurfaceNormal> surfaceNormal(const AkiMap& map, double x, double y, double z) {
    const auto n = normalAt(viewOf(map), x, y, z);
    if (!n) return std::nullopt;
    return SurfaceNormal{toMrpt(n->direction), n->confidence};
}

}  // namespace akimap
