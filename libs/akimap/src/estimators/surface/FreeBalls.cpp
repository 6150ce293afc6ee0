// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "estimators/surface/FreeBalls.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cmath>

#include "numeric/distance_transform.h"

namespace akimap {
namespace {

static_assert(kPowerSide == Block::kSide);

constexpr PowerBlock kNoBlock = [] {
    PowerBlock p{};
    for (uint16_t& v : p) v = kFarPower;
    return p;
}();

uint64_t keyBeside(uint64_t key, int axis, int step) {
    CellIndex b = unpackKey(key);
    (axis == 0 ? b.x : axis == 1 ? b.y : b.z) += step;
    return packKey(b);
}

}  // namespace

void FreeBalls::clear() {
    index_.clear(), keys_.clear(), blocks_.clear(), passes_.clear();
    markings_.clear();
    last_key_ = kNoKey;
    marks_ = 0;
}

uint32_t FreeBalls::numberOf(uint64_t key) {
    const uint32_t known = index_.find(key);
    if (known != KeyTable::kNone) return known;
    keys_.push_back(key);
    blocks_.push_back(kNoBlock);
    passes_.push_back({});
    markings_.push_back(Marking::steps);
    return index_.insert(key, static_cast<uint32_t>(keys_.size() - 1)).first;
}

void FreeBalls::merge(const FreeBalls& other) {
    marks_ += other.marks_;
    for (std::size_t b = 0; b < other.keys_.size(); b++) {
        const uint32_t number = numberOf(other.keys_[b]);
        markings_[number] = other.markings_[b];
        PowerBlock& here = blocks_[number];
        for (std::size_t i = 0; i < here.size(); i++)
            here[i] = std::min(here[i], other.blocks_[b][i]);
        PassesBlock& passes = passes_[number];
        for (std::size_t i = 0; i < passes.size(); i++)
            passes[i] = static_cast<uint8_t>(
                std::min<unsigned>(kMostPasses, passes[i] + other.passes_[b][i]));
    }
}

/** Adds the blocks beside those whose balls reach over a face. */
void FreeBalls::growAlong(int axis, double radius) {
    const int limit = static_cast<int>(std::ceil(radius * radius * kPowerUnit));
    const std::size_t n = keys_.size();
    std::vector<char> beyond(n);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, n, 64), [&](const auto& r) {
        for (std::size_t b = r.begin(); b != r.end(); ++b)
            beyond[b] = facesReached(blocks_[b], axis, limit);
    });
    for (std::size_t b = 0; b < n; b++) {
        if (beyond[b] & 1) numberOf(keyBeside(keys_[b], axis, -1));
        if (beyond[b] & 2) numberOf(keyBeside(keys_[b], axis, +1));
    }
}

void FreeBalls::transformAlong(int axis, int reach) {
    transformed_.resize(blocks_.size());
    const auto beside = [&](uint64_t key, int step) {
        const uint32_t n = index_.find(keyBeside(key, axis, step));
        return n == KeyTable::kNone ? kNoBlock.data() : blocks_[n].data();
    };
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, keys_.size(), 32), [&](const auto& r) {
        for (std::size_t b = r.begin(); b != r.end(); ++b)
            transformBlock(axis, {beside(keys_[b], -1), blocks_[b].data(), beside(keys_[b], +1)},
                           reach, transformed_[b].data());
    });
    blocks_.swap(transformed_);
}

void FreeBalls::transform(double radius) {
    const int reach = std::min(static_cast<int>(std::ceil(radius)), kMaxRadius);
    for (int axis = 0; axis < 3; axis++) {
        growAlong(axis, radius);
        transformAlong(axis, reach);
    }
}

}  // namespace akimap
