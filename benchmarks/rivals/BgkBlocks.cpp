// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "rivals/BgkBlocks.h"
#include "grid/BlockGrid.h"

#include <algorithm>

#include "estimators/kernels/kernel_function.h"

namespace akimap::bench {
namespace {

constexpr int kCells = 64;

/** A block and its face neighbours. */
std::array<CellIndex, 7> extended(const CellIndex& b) {
    return {{b,
             {b.x + 1, b.y, b.z},
             {b.x - 1, b.y, b.z},
             {b.x, b.y + 1, b.z},
             {b.x, b.y - 1, b.z},
             {b.x, b.y, b.z + 1},
             {b.x, b.y, b.z - 1}}};
}

/** Blocks are centred on multiples of their side: block 0 has cells -2 to 1. */
CellIndex blockOf(const CellIndex& c) {
    return {(c.x + 2) >> 2, (c.y + 2) >> 2, (c.z + 2) >> 2};
}

/** Two bits an axis, interleaved; x highest. */
int morton(const CellIndex& c) {
    const int x = (c.x + 2) & 3, y = (c.y + 2) & 3, z = (c.z + 2) & 3;
    return (x & 2) << 4 | (y & 2) << 3 | (z & 2) << 2 | (x & 1) << 2 | (y & 1) << 1 | (z & 1);
}
CellIndex cellOf(const CellIndex& b, int m) {
    return {4 * b.x - 2 + (m >> 4 & 2) + (m >> 2 & 1), 4 * b.y - 2 + (m >> 3 & 2) + (m >> 1 & 1),
            4 * b.z - 2 + (m >> 2 & 2) + (m & 1)};
}

/** Centres of a block's leaves [m]. */
struct Centers {
    int count = 0;
    std::array<float, kCells> x, y, z;
};

/** Adds the kernel at each centre's distance from the segment. \param length kernel's [m] */
void addKernel(const BgkBlocks::Sample& s, const Centers& c, float length, float* sums) {
    const auto ax = static_cast<float>(s.begin[0]), dx = static_cast<float>(s.end[0]) - ax;
    const auto ay = static_cast<float>(s.begin[1]), dy = static_cast<float>(s.end[1]) - ay;
    const auto az = static_cast<float>(s.begin[2]), dz = static_cast<float>(s.end[2]) - az;
    const float squared = dx * dx + dy * dy + dz * dz, inverse = squared > 1e-8f ? 1 / squared : 0;
    const float scale = 1 / (length * length);
    for (int i = 0; i < c.count; i++) {
        const float px = c.x[i] - ax, py = c.y[i] - ay, pz = c.z[i] - az;
        const float t = std::min(std::max((px * dx + py * dy + pz * dz) * inverse, 0.f), 1.f);
        const float ex = px - t * dx, ey = py - t * dy, ez = pz - t * dz;
        const float u = (ex * ex + ey * ey + ez * ez) * scale;
        sums[i] += kernelOfSquare(u, std::max(1 - u, 0.f));
    }
}

}  // namespace

CellIndex BgkBlocks::cellAt(const std::array<double, 3>& p) const {
    const auto axis = [&](double v) {
        return static_cast<int32_t>(std::floor(v / options_.resolution));
    };
    return {axis(p[0]), axis(p[1]), axis(p[2])};
}

void BgkBlocks::add(const Sample& sample, const std::vector<std::array<double, 3>>& places) {
    const auto id = static_cast<uint32_t>(samples_.size());
    samples_.push_back(sample);
    for (const auto& p : places) {
        const CellIndex block = blockOf(cellAt(p));
        const auto [i, is_new] =
            data_index_.insert(packKey(block), static_cast<uint32_t>(data_.size()));
        if (is_new) data_.emplace_back(), data_blocks_.push_back(block);
        if (data_[i].empty() || data_[i].back() != id) data_[i].push_back(id);
    }
}

void BgkBlocks::update() {
    KeyTable tested;
    for (const CellIndex& b : data_blocks_)
        for (const CellIndex& test : extended(b)) {
            if (!tested.insert(packKey(test), 0).second) continue;
            const auto [i, is_new] =
                index_.insert(packKey(test), static_cast<uint32_t>(blocks_.size()));
            if (is_new) {
                blocks_.emplace_back();
                for (uint8_t m = 0; m < kCells; m++) blocks_.back().push_back({m, 1, false, 0, 0});
            }
            predict(test, blocks_[i]);
            for (const int count : {1, 8}) merge(blocks_[i], count);
        }
    samples_.clear(), data_.clear(), data_blocks_.clear(), data_index_.clear();
}

void BgkBlocks::predict(const CellIndex& block, Leaves& leaves) const {
    Centers c;
    for (const Leaf& l : leaves) {
        const CellIndex first = cellOf(block, l.first);
        const double half = l.count == 1 ? 0.5 : l.count == 8 ? 1 : 2;
        c.x[c.count] = static_cast<float>((first.x + half) * options_.resolution);
        c.y[c.count] = static_cast<float>((first.y + half) * options_.resolution);
        c.z[c.count++] = static_cast<float>((first.z + half) * options_.resolution);
    }
    const auto length = static_cast<float>(options_.kernel_length);
    const auto variance = static_cast<float>(options_.kernel_variance);
    for (const CellIndex& b : extended(block)) {
        const uint32_t d = data_index_.find(packKey(b));
        if (d == KeyTable::kNone) continue;
        std::array<float, kCells> occupied{}, free{};
        for (const uint32_t id : data_[d]) {
            const Sample& s = samples_[id];
            addKernel(s, c, length, s.occupied ? occupied.data() : free.data());
        }
        for (std::size_t i = 0; i < leaves.size(); i++) {
            if (!(variance * (occupied[i] + free[i]) > options_.min_evidence)) continue;
            leaves[i].touched = true;
            leaves[i].alpha += variance * occupied[i], leaves[i].beta += variance * free[i];
        }
    }
}

BgkBlocks::State BgkBlocks::state(const Leaf& l) const {
    const double a = l.alpha + options_.prior, b = l.beta + options_.prior, n = a + b, p = a / n;
    if (p * (1 - p) / (n + 1) > options_.variance_threshold) return State::unknown;
    return p > options_.occupied_threshold ? State::occupied
           : p < options_.free_threshold   ? State::free
                                           : State::unknown;
}

/** Merges eight siblings of `count` cells each where all are free or all occupied. */
void BgkBlocks::merge(Leaves& leaves, int count) const {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < leaves.size();) {
        const auto begin = leaves.begin() + static_cast<std::ptrdiff_t>(i);
        const State first = state(*begin);
        const bool mergeable =
            first != State::unknown && begin->first % (8 * count) == 0 && i + 8 <= leaves.size() &&
            std::all_of(begin, begin + 8,
                        [&](const Leaf& l) { return l.count == count && state(l) == first; });
        leaves[kept] = leaves[i];
        if (mergeable) leaves[kept].count = static_cast<uint8_t>(8 * count);
        kept++, i += mergeable ? 8 : 1;
    }
    leaves.resize(kept);
}

std::optional<double> BgkBlocks::occupancy(double x, double y, double z) const {
    const CellIndex cell = cellAt({x, y, z});
    const uint32_t i = index_.find(packKey(blockOf(cell)));
    if (i == KeyTable::kNone) return std::nullopt;
    const int m = morton(cell);
    const Leaf& leaf = *std::find_if(blocks_[i].begin(), blocks_[i].end(),
                                     [m](const Leaf& l) { return m < l.first + l.count; });
    if (!leaf.touched) return std::nullopt;
    const double a = leaf.alpha + options_.prior, b = leaf.beta + options_.prior;
    return a / (a + b);
}

}  // namespace akimap::bench
