// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "numeric/distance_transform.h"

#include <cstring>

#include "numeric/rows.h"

namespace akimap {
namespace {

constexpr int kSide = kPowerSide, kLayer = kSide * kSide, kCells = kSide * kLayer;
using Cells = uint16_t __attribute__((vector_size(16)));    // a row of a block
using TwoRows = uint16_t __attribute__((vector_size(32)));  // two rows, one behind the other

template <class T>
AKIMAP_INLINE T load(const uint16_t* p) {
    T v;
    std::memcpy(&v, p, sizeof v);
    return v;
}
template <class T>
AKIMAP_INLINE void store(uint16_t* p, T v) {
    std::memcpy(p, &v, sizeof v);
}
template <class T>
AKIMAP_INLINE T lesser(T a, T b) {
    return a < b ? a : b;
}
/** What d cells on one axis add to a power distance. */
constexpr uint16_t cost(int d) {
    return static_cast<uint16_t>(kPowerUnit * d * d);
}

/** Of two rows each: moved by D cells along x, filled up from the rows before them. */
template <int D>
AKIMAP_INLINE TwoRows movedUp(TwoRows before, TwoRows here) {
    constexpr int a = 8 - D, b = 16 - D;  // in the first rows, and from where on in the second
    constexpr auto at = [](int i) { return i < 8 ? i : i + 8; };
    constexpr auto at2 = [](int i) { return i < 16 ? i : i + 8; };
    return __builtin_shufflevector(before, here, at(a), at(a + 1), at(a + 2), at(a + 3), at(a + 4),
                                   at(a + 5), at(a + 6), at(a + 7), at2(b), at2(b + 1), at2(b + 2),
                                   at2(b + 3), at2(b + 4), at2(b + 5), at2(b + 6), at2(b + 7));
}
template <int D>
AKIMAP_INLINE TwoRows leastWithin(TwoRows before, TwoRows here, TwoRows after) {
    if constexpr (D == 0) {
        return here;
    } else {
        const TwoRows at = lesser(movedUp<D>(before, here), movedUp<kSide - D>(here, after));
        return lesser(leastWithin<D - 1>(before, here, after), at + cost(D));
    }
}

/** out[x] = min over |d| <= Reach of in[x + d] + cost(d). */
template <int Reach>
AKIMAP_INLINE void transformX(const Neighborhood& of, uint16_t* out) {
    for (int i = 0; i < kCells; i += 2 * kSide)
        store(out + i, leastWithin<Reach>(load<TwoRows>(of.before + i), load<TwoRows>(of.here + i),
                                          load<TwoRows>(of.after + i)));
}

/** The same along y or z: from pieces of `Stride` cells that lie one behind the other. */
template <int Reach, int Stride, class T>
AKIMAP_INLINE void transformPieces(const Neighborhood& of, uint16_t* out) {
    constexpr int kStep = sizeof(T) / sizeof(uint16_t);
    for (int c = 0; c < Stride; c += kStep) {
        T in[3 * kSide];
        for (int i = 0; i < kSide; i++) {
            in[i] = load<T>(of.before + i * Stride + c);
            in[kSide + i] = load<T>(of.here + i * Stride + c);
            in[2 * kSide + i] = load<T>(of.after + i * Stride + c);
        }
#pragma GCC unroll 8
        for (int i = 0; i < kSide; i++) {
            const T* here = in + kSide + i;
            T least = *here;
#pragma GCC unroll 8
            for (int d = 1; d <= Reach; d++)
                least = lesser(least, lesser(here[-d], here[d]) + cost(d));
            store(out + i * Stride + c, least);
        }
    }
}

template <int Reach>
AKIMAP_INLINE void transformAll(int axis, const Neighborhood& of, uint16_t* out) {
    if (axis == 0) return transformX<Reach>(of, out);
    if (axis == 2) return transformPieces<Reach, kLayer, TwoRows>(of, out);
    for (int z = 0; z < kCells; z += kLayer)
        transformPieces<Reach, kSide, Cells>({of.before + z, of.here + z, of.after + z}, out + z);
}

/** The least power distances of the 8 layers across an axis: for x the layers are the lanes of the
 * first, for y and z the lanes are cells of a layer. */
AKIMAP_INLINE void leastOfLayers(const PowerBlock& block, int axis, Cells (&least)[kSide]) {
    for (Cells& l : least) l = Cells{} + kFarPower;
    for (int z = 0; z < kSide; z++)
        for (int y = 0; y < kSide; y++) {
            Cells& l = least[axis == 2 ? z : y];
            l = lesser(l, load<Cells>(block.data() + (z * kSide + y) * kSide));
        }
    if (axis > 0) return;
    for (int y = 1; y < kSide; y++) least[0] = lesser(least[0], least[y]);
}

AKIMAP_INLINE bool anyBelow(Cells v, int limit) {
    using Words = uint64_t __attribute__((vector_size(16)));
    const Words w = (Words)(v < static_cast<uint16_t>(limit));
    return (w[0] | w[1]) != 0;
}

}  // namespace

// Each reach has loops of its own, which are unrolled.
AKIMAP_MULTIVERSION
void transformBlock(int axis, const Neighborhood& of, int reach, uint16_t* out) {
    switch (reach) {
        case 1:
            return transformAll<1>(axis, of, out);
        case 2:
            return transformAll<2>(axis, of, out);
        case 3:
            return transformAll<3>(axis, of, out);
        case 4:
            return transformAll<4>(axis, of, out);
        case 5:
            return transformAll<5>(axis, of, out);
        case 6:
            return transformAll<6>(axis, of, out);
        case 7:
            return transformAll<7>(axis, of, out);
        default:
            return transformAll<8>(axis, of, out);
    }
}

AKIMAP_MULTIVERSION
char facesReached(const PowerBlock& block, int axis, int limit) {
    Cells least[kSide], low, high;
    leastOfLayers(block, axis, least);
    if (axis == 0) {
        constexpr Cells kPlace = {1, 2, 3, 4, 5, 6, 7, 8};
        low = least[0] + kPlace * kPlace * uint16_t{kPowerUnit};
        high = least[0] + (9 - kPlace) * (9 - kPlace) * uint16_t{kPowerUnit};
    } else {
        low = least[0] + cost(1), high = least[kSide - 1] + cost(1);
        for (int i = 1; i < kSide; i++) {
            low = lesser(low, least[i] + cost(i + 1));
            high = lesser(high, least[kSide - 1 - i] + cost(i + 1));
        }
    }
    return static_cast<char>((anyBelow(low, limit) ? 1 : 0) | (anyBelow(high, limit) ? 2 : 0));
}

}  // namespace akimap
