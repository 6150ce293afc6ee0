// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <akimap/AkiMap.h>
#include <akimap/Cell.h>

#include <optional>
#include <vector>

namespace akimap {

// What planners ask a map. All are const-thread-safe; lengths are in metres, map frame.

/** A place on a way and how sure the map is that it is free there. */
struct FreeConfidence {
    mrpt::math::TPoint3D place;
    double confidence = 1;  ///< confidenceInFree()
};

/** What a ray meets. */
struct RayCast {
    std::optional<double> hit;  ///< [m] from the origin to where it enters the first occupied cell
    FreeConfidence least_sure;  ///< before the hit; the origin if nothing is before it
};
/** The cells along a ray, one after the other (Amanatides and Woo 1987).
 * \param direction need not be of unit length
 * \param threshold cells of a higher occupancy are occupied
 * \exception std::invalid_argument unless all numbers are finite, the direction is not zero and
 * 0 < threshold < 1 */
[[nodiscard]] RayCast castRay(const AkiMap& map, const mrpt::math::TPoint3D& origin,
                              const mrpt::math::TVector3D& direction, double max_range,
                              double threshold = 0.5);

/** Whether a sphere can move along a path of straight pieces. */
struct SweptPath {
    std::optional<mrpt::math::TPoint3D> collision;  ///< the first occupied cell's centre
    FreeConfidence least_sure;                      ///< of all cells that the sphere touches
};
/** Looks at every cell that the sphere touches, piece by piece in the path's order.
 * \param path at least one place \param radius >= 0
 * \exception std::invalid_argument unless all numbers are finite and in range */
[[nodiscard]] SweptPath sweepSphere(const AkiMap& map,
                                    const std::vector<mrpt::math::TPoint3D>& path, double radius,
                                    double threshold = 0.5);

/** Which way the surface faces at a cell. */
struct SurfaceNormal {
    mrpt::math::TVector3D direction;  ///< of unit length, towards the freer side
    /** In [0, 1]: 1 - sqrt(v1 / v2), the thickness across over the smaller extent along, of the
     * variances v1 <= v2 <= v3 below. 1: a wall one cell thick; 0.65: two; 0: a clump of cells.
     * It tells shape only; how often a cell was seen is in its CellState. */
    double confidence;
};
/** By the principal axes of the occupied cells within two cells of the one that holds the point:
 * the eigenvectors and eigenvalues v of their centres' covariance, weighted by occupancy; empty
 * where there are too few of them. */
[[nodiscard]] std::optional<SurfaceNormal> surfaceNormal(const AkiMap& map, double x, double y,
                                                         double z);

}  // namespace akimap
