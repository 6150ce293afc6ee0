// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <akimap/Ray.h>

#include "FreeSpace.h"

namespace akimap {

/** Marks the free space along beams that met nothing: balls as along a hit's ray, all within the
 * sphere of the beam's length about its origin.
 * \param beams cut off where they are known to be free
 * \param radius [cells] of the balls; they are smaller only near the beam's end
 * \param anchor of the samples: the blocks of `free` are relative to it
 * \return number of balls */
std::size_t markFreeBeams(const std::vector<Ray>& beams, double radius, double resolution,
                          const CellIndex& anchor, FreeSpace& free);

}  // namespace akimap
