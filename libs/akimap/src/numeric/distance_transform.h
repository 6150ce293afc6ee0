// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include "estimators/surface/FreeBalls.h"

namespace akimap {

/** The power distances of a block and of the two beside it on one axis. */
struct Neighborhood {
    const uint16_t *before, *here, *after;
};

/** out = min over |d| <= reach cells along an axis (0 to 2) of the power distance there + d^2.
 * \param reach in [1, FreeSpace::kMaxRadius] */
void spreadBlock(int axis, const Neighborhood& of, int reach, uint16_t* out);

/** Whether balls reach over the faces across an axis: 1 the lower, 2 the upper, 3 both.
 * \param limit R^2 [cells^2 / kUnit] */
[[nodiscard]] char facesReached(const FreeSpace::Plane& plane, int axis, int limit);

}  // namespace akimap
