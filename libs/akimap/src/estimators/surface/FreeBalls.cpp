// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "estimators/surface/FreeBalls.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cmath>

#include "numeric/distance_transform.h"

namespace akimap {
namespace {

constexpr FreeSpace::Plane kNoBlock = [] {
    FreeSpace::Plane p{};
    for (uint16_t& v : p) v = FreeSpace::kFar;
    return p;
}();

uint64_t keyBeside(uint64_t key, int axis, int step) {
    CellIndex b = unpackKey(key);
    (axis == 0 ? b.x : axis == 1 ? b.y : b.z) += step;
    return packKey(b);
}

}  // namespace

void FreeSpace::clear() {
    index_.clear(), keys_.clear(), planes_.clear();
    last_cell_ = kNowhere;
}

uint32_t FreeSpace::numberOf(uint64_t key) {
    const uint32_t known = index_.find(key);
    if (known != KeyTable::kNone) return known;
    keys_.push_back(key);
    planes_.push_back(kNoBlock);
    return index_.insert(key, static_cast<uint32_t>(keys_.size() - 1)).first;
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
