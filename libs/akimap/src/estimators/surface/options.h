// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <akimap/Parameters.h>

namespace akimap {

/** Calls visit(name, field, comment) for each option. */
template <class Parameters, class Visitor>
void visitSurfaceFields(Parameters& o, Visitor&& visit) {
    visit("surface_range", o.surface_range,
          "[m] > 0. surface: neighbours of a hit are sought no farther");
    visit("free_radius", o.free_radius,
          "[m] > 0. surface: how far free space reaches from a ray; 1.5 to 8 cells");
    visit("max_evidence", o.max_evidence,
          "[-] 0 or >= 1. surface: bound of alpha + beta, so that old scans fade; 0: none");
}

/** [cells] How far free space reaches from a ray: wide enough that neighbouring balls leave no
 * hole, and no farther than the distance transform. */
[[nodiscard]] double freeRadiusInCells(const SurfaceParameters& p, double resolution);

/** As the estimator uses them at this cell size [m]. */
[[nodiscard]] SurfaceParameters surfaceInForce(SurfaceParameters p, double resolution);

}  // namespace akimap
