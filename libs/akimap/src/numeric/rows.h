// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <cstdint>

// Rows of eight floats by the compiler's vector extensions: AVX registers where
// the function is compiled for them, pairs of SSE registers elsewhere.

/** Put before a function whose loops run on rows: it is compiled for plain
 * x86-64 and for AVX2, and the machine's best version is taken when the library
 * is loaded. */
#if defined(__x86_64__) && !defined(AKIMAP_PLAIN) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define AKIMAP_MULTIVERSION [[gnu::target_clones("arch=x86-64-v3", "default")]]
#else
#define AKIMAP_MULTIVERSION
#endif
/** The same for lambdas, between their parameters and their body. */
#define AKIMAP_INLINE_LAMBDA __attribute__((always_inline))
/** Put before every helper such a function calls: it must be compiled with its
 * caller. */
#define AKIMAP_INLINE [[gnu::always_inline]] inline

namespace akimap {

using Row = float __attribute__((vector_size(32)));
using RowMask = int32_t __attribute__((vector_size(32)));
using DoubleRow = double __attribute__((vector_size(32)));
using DoubleRowMask = int64_t __attribute__((vector_size(32)));
constexpr RowMask kLaneIndex = {0, 1, 2, 3, 4, 5, 6, 7};

AKIMAP_INLINE Row loadRow(const float* p) {
    using Unaligned = float __attribute__((vector_size(32), aligned(4)));
    return *reinterpret_cast<const Unaligned*>(p);
}
AKIMAP_INLINE DoubleRow loadRow(const double* p) {
    using Unaligned = double __attribute__((vector_size(32), aligned(8)));
    return *reinterpret_cast<const Unaligned*>(p);
}
AKIMAP_INLINE void storeRow(float* p, Row v) {
    using Unaligned = float __attribute__((vector_size(32), aligned(4)));
    *reinterpret_cast<Unaligned*>(p) = v;
}
AKIMAP_INLINE void storeRow(uint32_t* p, RowMask v) {
    using Unaligned = int32_t __attribute__((vector_size(32), aligned(4), may_alias));
    *reinterpret_cast<Unaligned*>(p) = v;
}
/** v where the mask is set, 0 elsewhere. */
AKIMAP_INLINE Row keep(RowMask m, Row v) {
    return (Row)(m & (RowMask)v);
}
AKIMAP_INLINE DoubleRow keep(DoubleRowMask m, DoubleRow v) {
    return (DoubleRow)(m & (DoubleRowMask)v);
}
AKIMAP_INLINE double keep(bool m, double v) {
    return m ? v : 0;
}
AKIMAP_INLINE void storeRow(double* p, DoubleRow v) {
    using Unaligned = double __attribute__((vector_size(32), aligned(8)));
    *reinterpret_cast<Unaligned*>(p) = v;
}
using HalfRow = float __attribute__((vector_size(16)));
AKIMAP_INLINE Row joined(DoubleRow low, DoubleRow high) {
    const HalfRow a = __builtin_convertvector(low, HalfRow),
                  b = __builtin_convertvector(high, HalfRow);
    return __builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7);
}
/** Bit i is lane i of the mask. */
AKIMAP_INLINE uint32_t bitsOf(RowMask m) {
    using HalfMask = int32_t __attribute__((vector_size(16)));
    using Words = uint64_t __attribute__((vector_size(16)));
    constexpr RowMask kBits = {1, 2, 4, 8, 16, 32, 64, 128};
    m &= kBits;
    const Words w = (Words)(HalfMask)(__builtin_shufflevector(m, m, 0, 1, 2, 3) |
                                      __builtin_shufflevector(m, m, 4, 5, 6, 7));
    const uint64_t both = w[0] | w[1];
    return static_cast<uint32_t>(both | both >> 32);
}
/** The lanes as bytes, lane 0 the lowest; each is < 256. */
AKIMAP_INLINE uint64_t bytesOf(RowMask m) {
    using Words = uint64_t __attribute__((vector_size(32)));
    const Words two = (Words)m | (Words)m >> 24;  // lanes in the lowest bytes
    const Words w = (two & 0xffff) << Words{0, 16, 32, 48};
    const auto half = __builtin_shufflevector(w, w, 0, 1) | __builtin_shufflevector(w, w, 2, 3);
    return half[0] | half[1];
}
/** Of the lanes, in doubles. */
AKIMAP_INLINE double sumOf(Row v) {
    const HalfRow low = {v[0], v[1], v[2], v[3]}, high = {v[4], v[5], v[6], v[7]};
    const DoubleRow s =
        __builtin_convertvector(low, DoubleRow) + __builtin_convertvector(high, DoubleRow);
    return (s[0] + s[2]) + (s[1] + s[3]);
}
/** The lanes of each set of bits, in order. */
struct LaneTable {
    alignas(32) int32_t lanes[256][8] = {};
    constexpr LaneTable() {
        for (unsigned bits = 0; bits < 256; bits++) {
            unsigned n = 0;
            for (int lane = 0; lane < 8; lane++)
                if (bits >> lane & 1) lanes[bits][n++] = lane;
        }
    }
};
inline constexpr LaneTable kLanes;
AKIMAP_INLINE RowMask lanesOf(uint32_t bits) {
    return *reinterpret_cast<const RowMask*>(kLanes.lanes[bits]);
}
/** The lanes of v whose bits are set, moved to the front; the others are of no
 * use. */
AKIMAP_INLINE Row packed(Row v, uint32_t bits) {
#ifdef __clang__  // which has none whose lanes are not constants; it builds the fuzzers only
    const RowMask lanes = lanesOf(bits);
    Row front{};
    for (int i = 0; i < 8; i++) front[i] = v[lanes[i]];
    return front;
#else
    return __builtin_shuffle(v, lanesOf(bits));
#endif
}

}  // namespace akimap
