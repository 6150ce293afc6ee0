// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <cmath>

#include "estimators/kernels/kernel_binning.h"
#include "numeric/rows.h"

// A kernel cut into the layers and rows of a block's cells: what they share of 1 - r^2.

namespace akimap {

/** The axis of the eight cells of a layer that are added to at once. */
enum class Lanes : uint8_t { x, y };

/** Of a kernel's layers in a block: in layer z, 1 - r^2 = left[z] - ey^2 iy - ex^2 ix with
 * ey = y - y0[z] and ex = x - x0[z] - x_y ey. */
struct Layers {
    alignas(32) double y0[kSide];
    alignas(32) double x0[kSide];
    alignas(32) float left[kSide];
};

/** Of a kernel's rows in a block: row r = (y, z) runs along x, and its cells have
 * 1 - r^2 = left[r] - (x - x0[r])^2 ix. */
struct Rows {
    alignas(32) double x0[kSide * kSide];
    alignas(32) float left[kSide * kSide];
};

/** Places 0 to 7 minus a place, in doubles until they are small: a thin kernel far from the
 * block's corner keeps its digits. */
constexpr DoubleRow kLow = {0, 1, 2, 3}, kHigh = {4, 5, 6, 7};

constexpr double kPlaces[] = {0, 1, 2, 3, 4, 5, 6, 7};

constexpr float kMargin = 0.01f;  // [cells] more than the roundings

AKIMAP_INLINE Row lesser(Row a, Row b) {
    return a < b ? a : b;
}

/** The root or up to 0.1 % more, of v > 0: a guess by half of the exponent, and Newton's step,
 * which is never too low. */
AKIMAP_INLINE Row rootOrMore(Row v) {
    const Row guess = (Row)(((RowMask)v >> 1) + 0x1fbd1df5);
    return 0.5f * (guess + v / guess);
}

/** One bit for each of eight places that may be within so far of a middle, in every lane. */
AKIMAP_INLINE RowMask placesWithin(Row half, Row middle) {
    constexpr Row zero{}, side = zero + static_cast<float>(kSide);
    const auto whole = [=](Row v) AKIMAP_INLINE_LAMBDA {
        return __builtin_convertvector(lesser(v > zero ? v : zero, side), RowMask);
    };
    const RowMask one = kLaneIndex * 0 + 1;
    return (one << whole(middle + half + 1.0f)) - (one << whole(middle - half + (1 - kMargin)));
}

/** Cuts a kernel into the layers of the block with this lowest cell.
 * \return one bit for each eight cells along the lanes, those of layer 0 first: whether the kernel
 * may reach one of them */
template <Lanes lanes>
AKIMAP_INLINE uint64_t cutIntoLayers(const Kernel& k, const CellIndex& corner,
                                     const BlockOverlap& overlap, Layers& layers) {
    const double cz = k.z - corner.z, cy = k.y - corner.y, cx = k.x - corner.x;
    const DoubleRow low = kLow - cz, high = kHigh - cz;
    const Row left = 1.0f - joined(low * low, high * high) * k.iz;
    const DoubleRow y_low = cy + k.y_z * low, y_high = cy + k.y_z * high, x_low = cx + k.x_z * low,
                    x_high = cx + k.x_z * high;
    storeRow(layers.left, left);
    storeRow(layers.y0, y_low), storeRow(layers.y0 + 4, y_high);
    storeRow(layers.x0, x_low), storeRow(layers.x0 + 4, x_high);

    constexpr float kLeast = 1e-5f, kMiddle = 3.5f;
    const auto x_y = static_cast<float>(k.x_y);
    const float v_y = 1 / k.iy, v_x = 1 / k.ix + x_y * x_y * v_y;  // [cells^2] in a layer
    const Row root = rootOrMore(left > 0.0f ? left + kLeast : Row{} + kLeast);
    const Row y = joined(y_low, y_high), half_y = root * std::sqrt(v_y) + kMargin;
    const Row x = joined(x_low, x_high), half_x = root * std::sqrt(v_x) + kMargin;
    const Row across = (lanes == Lanes::x ? x : y) - kMiddle,
              half_across = lanes == Lanes::x ? half_x : half_y;
    const Row distance = (Row)((RowMask)across & INT32_MAX) - kMiddle;
    const RowMask meets = (distance < half_across) & (kLaneIndex >= overlap.begin) &
                          (kLaneIndex < overlap.end),
                  places = lanes == Lanes::x ? placesWithin(half_y, y) : placesWithin(half_x, x);
    return bytesOf(places & meets);
}

/** Cuts layers [begin, end) into rows. */
AKIMAP_INLINE void cutIntoRows(const Kernel& k, const Layers& layers, int begin, int end,
                               Rows& rows) {
    for (int z = begin; z < end; z++) {
        const DoubleRow low = kLow - layers.y0[z], high = kHigh - layers.y0[z];
        const Row ey = joined(low, high);
        storeRow(rows.left + z * kSide, layers.left[z] - ey * ey * k.iy);
        storeRow(rows.x0 + z * kSide, layers.x0[z] + k.x_y * low);
        storeRow(rows.x0 + z * kSide + 4, layers.x0[z] + k.x_y * high);
    }
}

}  // namespace akimap
