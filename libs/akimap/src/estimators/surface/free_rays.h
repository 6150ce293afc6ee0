// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include "estimators/surface/FreeBalls.h"
#include "estimators/surface/hit_planes.h"

namespace akimap {

/** Marks the free space along each hit's ray: balls as wide as the gaps between rays, and narrower
 * where the hit's surface is near, whose plane they hardly cross. Each thread marks some of the
 * rays; the least of their powers does not depend on which. Runs in the caller's TBB arena.
 * \param radius R [cells]
 * \param anchor of the samples: the blocks of `free` are relative to it
 * \param parts scratch
 * \return number of balls */
std::size_t markHitRays(const std::vector<KeptRay>& rays, const std::vector<HitPlane>& planes,
                        double radius, double resolution, const CellIndex& anchor,
                        std::vector<FreeBalls>& parts, FreeBalls& free);

/** Marks more, along beams that met nothing: balls within the sphere of the beam's length about its
 * origin.
 * \param beams cut off where they are known to be free
 * \return number of balls */
std::size_t markBeams(const std::vector<Ray>& beams, double radius, double resolution,
                      const CellIndex& anchor, FreeBalls& free);

}  // namespace akimap
