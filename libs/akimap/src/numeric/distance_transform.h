// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <array>
#include <cstdint>

// The squared distance transform of Felzenszwalb and Huttenlocher (2012) on blocks of 8^3 whole
// numbers, one axis after the other.

namespace akimap {

/** Power distances of the cells of a block, x running fastest: squared distances in units of
 * 1 / kPowerUnit cell^2. */
struct alignas(32) PowerBlock : std::array<uint16_t, 512> {};
inline constexpr int kPowerSide = 8;           ///< [cells] of a block
inline constexpr int kPowerUnit = 64;          ///< units of a cell^2
inline constexpr uint16_t kFarPower = 0x3fff;  ///< more than any within reach

/** The power distances of a block and of the two beside it on one axis. */
struct Neighborhood {
    const uint16_t *before, *here, *after;
};

/** out = min over |d| <= reach cells along an axis (0 to 2) of the power distance there + d^2.
 * \param reach in [1, kPowerSide] */
void transformBlock(int axis, const Neighborhood& of, int reach, uint16_t* out);

/** Whether a distance below the limit reaches over the faces across an axis: 1 the lower, 2 the
 * upper, 3 both. \param limit [cells^2 / kPowerUnit] */
[[nodiscard]] char facesReached(const PowerBlock& block, int axis, int limit);

}  // namespace akimap
