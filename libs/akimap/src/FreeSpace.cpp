// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "FreeSpace.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <cstring>

#include "simd.h"

namespace akimap {
namespace {

constexpr int kSide = Block::kSide, kLayer = kSide * kSide;
using Cells = uint16_t __attribute__((vector_size(16)));    // a row of a block
using TwoRows = uint16_t __attribute__((vector_size(32)));  // two rows, one behind the other
constexpr FreeSpace::Plane kNoBlock = [] {
    FreeSpace::Plane p{};
    for (uint16_t& v : p) v = FreeSpace::kFar;
    return p;
}();

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
    return static_cast<uint16_t>(FreeSpace::kUnit * d * d);
}

/** A block and the two beside it on one axis. */
struct Neighborhood {
    const uint16_t *before, *here, *after;
};

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
AKIMAP_INLINE void spreadX(const Neighborhood& of, uint16_t* out) {
    for (int i = 0; i < Block::kCells; i += 2 * kSide)
        store(out + i, leastWithin<Reach>(load<TwoRows>(of.before + i), load<TwoRows>(of.here + i),
                                          load<TwoRows>(of.after + i)));
}

/** The same along y or z: from pieces of `Stride` cells that lie one behind the other. */
template <int Reach, int Stride, class T>
AKIMAP_INLINE void spreadPieces(const Neighborhood& of, uint16_t* out) {
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
AKIMAP_INLINE void spreadAll(int axis, const Neighborhood& of, uint16_t* out) {
    if (axis == 0) return spreadX<Reach>(of, out);
    if (axis == 2) return spreadPieces<Reach, kLayer, TwoRows>(of, out);
    for (int z = 0; z < Block::kCells; z += kLayer)
        spreadPieces<Reach, kSide, Cells>({of.before + z, of.here + z, of.after + z}, out + z);
}

/** \param reach in [1, kMaxRadius]: each has a loop of its own, which is unrolled */
AKIMAP_MULTIVERSION
void spreadBlock(int axis, const Neighborhood& of, int reach, uint16_t* out) {
    switch (reach) {
        case 1:
            return spreadAll<1>(axis, of, out);
        case 2:
            return spreadAll<2>(axis, of, out);
        case 3:
            return spreadAll<3>(axis, of, out);
        case 4:
            return spreadAll<4>(axis, of, out);
        case 5:
            return spreadAll<5>(axis, of, out);
        case 6:
            return spreadAll<6>(axis, of, out);
        case 7:
            return spreadAll<7>(axis, of, out);
        default:
            return spreadAll<8>(axis, of, out);
    }
}

uint64_t keyBeside(uint64_t key, int axis, int step) {
    CellIndex b = unpackKey(key);
    (axis == 0 ? b.x : axis == 1 ? b.y : b.z) += step;
    return packKey(b);
}

/** The least power distances of the 8 layers across an axis: for x the layers are the lanes of the
 * first, for y and z the lanes are cells of a layer. */
AKIMAP_INLINE void leastOfLayers(const FreeSpace::Plane& plane, int axis, Cells (&least)[kSide]) {
    for (Cells& l : least) l = Cells{} + FreeSpace::kFar;
    for (int z = 0; z < kSide; z++)
        for (int y = 0; y < kSide; y++) {
            Cells& l = least[axis == 2 ? z : y];
            l = lesser(l, load<Cells>(plane.data() + (z * kSide + y) * kSide));
        }
    if (axis > 0) return;
    for (int y = 1; y < kSide; y++) least[0] = lesser(least[0], least[y]);
}

AKIMAP_INLINE bool anyBelow(Cells v, int limit) {
    using Words = uint64_t __attribute__((vector_size(16)));
    const Words w = (Words)(v < static_cast<uint16_t>(limit));
    return (w[0] | w[1]) != 0;
}

/** Whether balls reach over the faces across an axis: 1 the lower, 2 the upper, 3 both. */
AKIMAP_MULTIVERSION
char facesReached(const FreeSpace::Plane& plane, int axis, int limit) {
    Cells least[kSide], low, high;
    leastOfLayers(plane, axis, least);
    if (axis == 0) {
        constexpr Cells kPlace = {1, 2, 3, 4, 5, 6, 7, 8};
        low = least[0] + kPlace * kPlace * uint16_t{FreeSpace::kUnit};
        high = least[0] + (9 - kPlace) * (9 - kPlace) * uint16_t{FreeSpace::kUnit};
    } else {
        low = least[0] + cost(1), high = least[kSide - 1] + cost(1);
        for (int i = 1; i < kSide; i++) {
            low = lesser(low, least[i] + cost(i + 1));
            high = lesser(high, least[kSide - 1 - i] + cost(i + 1));
        }
    }
    return static_cast<char>((anyBelow(low, limit) ? 1 : 0) | (anyBelow(high, limit) ? 2 : 0));
}

}  // namespace

void FreeSpace::clear() {
    index_.clear(), keys_.clear(), planes_.clear();
    last_key_ = kNoKey;
}

uint32_t FreeSpace::numberOf(uint64_t key) {
    const auto [number, added] = index_.insert(key, static_cast<uint32_t>(keys_.size()));
    if (!added) return number;
    keys_.push_back(key);
    planes_.push_back(kNoBlock);
    return number;
}

void FreeSpace::merge(const FreeSpace& other) {
    for (std::size_t b = 0; b < other.keys_.size(); b++) {
        Plane& here = planes_[numberOf(other.keys_[b])];
        for (std::size_t i = 0; i < here.size(); i++)
            here[i] = std::min(here[i], other.planes_[b][i]);
    }
}

/** Adds the blocks beside those whose balls reach over a face. */
void FreeSpace::growAlong(int axis, double radius) {
    const int limit = static_cast<int>(std::ceil(radius * radius * kUnit));
    const std::size_t n = keys_.size();
    std::vector<char> beyond(n);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, n, 64), [&](const auto& r) {
        for (std::size_t b = r.begin(); b != r.end(); ++b)
            beyond[b] = facesReached(planes_[b], axis, limit);
    });
    for (std::size_t b = 0; b < n; b++) {
        if (beyond[b] & 1) numberOf(keyBeside(keys_[b], axis, -1));
        if (beyond[b] & 2) numberOf(keyBeside(keys_[b], axis, +1));
    }
}

void FreeSpace::spreadAlong(int axis, int reach) {
    spread_.resize(planes_.size());
    const auto beside = [&](uint64_t key, int step) {
        const uint32_t n = index_.find(keyBeside(key, axis, step));
        return n == KeyTable::kNone ? kNoBlock.data() : planes_[n].data();
    };
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, keys_.size(), 32), [&](const auto& r) {
        for (std::size_t b = r.begin(); b != r.end(); ++b)
            spreadBlock(axis, {beside(keys_[b], -1), planes_[b].data(), beside(keys_[b], +1)},
                        reach, spread_[b].data());
    });
    planes_.swap(spread_);
}

void FreeSpace::spread(double radius) {
    const int reach = std::min(static_cast<int>(std::ceil(radius)), kMaxRadius);
    for (int axis = 0; axis < 3; axis++) {
        growAlong(axis, radius);
        spreadAlong(axis, reach);
    }
}

}  // namespace akimap
