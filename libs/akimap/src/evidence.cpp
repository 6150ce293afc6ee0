// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "evidence.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace akimap {
namespace {
constexpr double kClearance = 1.5;     // a ball's radius over its distance from the hit's plane
constexpr double kStep = 0.5;          // from ball to ball, over the radius
constexpr double kLeastBall = 0.25;    // [cells]
constexpr float kLeastSurface = 0.1f;  // of a, where nothing else is known of a cell
constexpr float kSurfaceWeight = 2;    // a surface counts as much as so many free spaces

/** What one scan says of a block: the sums of its surface kernels, and its power distances; either
 * may be missing. */
struct ScanBlock {
    const float* surface;
    const uint16_t* power;
};

/** Scales both down where they are more than the bound in sum, but not to denormal numbers, which
 * are slow. */
AKIMAP_INLINE void boundSum(float bound, Row& alpha, Row& beta) {
    constexpr Row one = {1, 1, 1, 1, 1, 1, 1, 1};
    const Row sum = alpha + beta, scale = sum > bound ? bound / sum : one;
    for (Row* v : {&alpha, &beta}) {
        const Row least = *v < 1e-20f ? *v : 1e-20f * one, scaled = *v * scale;
        *v = scaled > least ? scaled : least;
    }
}

/** Adds one scan to a block. \return whether a cell of it gained evidence */
AKIMAP_MULTIVERSION
bool addBlock(const ScanBlock& scan, float inverse_limit, float bound, Block& block) {
    using Powers = uint16_t __attribute__((vector_size(16)));
    constexpr Row one = {1, 1, 1, 1, 1, 1, 1, 1};
    RowMask gained{};
    for (int i = 0; i < Block::kCells; i += Block::kSide) {
        Row alpha = loadRow(block.alpha.data() + i), beta = loadRow(block.beta.data() + i);
        Row a{}, b{};
        if (scan.power) {
            Powers power;
            std::memcpy(&power, scan.power + i, sizeof power);
            const Row inside = one - __builtin_convertvector(power, Row) * inverse_limit;
            b = keep(inside > 0.0f, inside);
        }
        if (scan.surface) {
            const Row sum = loadRow(scan.surface + i);
            const RowMask counts = (sum >= kLeastSurface) | (b + alpha + beta > 0.0f);
            a = keep(counts, sum < one ? sum : one);
            b *= one - a;
        }
        gained |= (a > 0.0f) | (b > 0.0f);
        alpha += kSurfaceWeight * a, beta += b;
        boundSum(bound, alpha, beta);
        storeRow(block.alpha.data() + i, alpha);
        storeRow(block.beta.data() + i, beta);
    }
    return bitsOf(gained != 0) != 0;
}

/** Of a ray, away from its hit: where balls go. */
struct Walk {
    std::array<double, 3> end, back;  // [m] the hit, and the unit vector towards the origin
    double length;                    // [m]
    double rise;  // distance gained from the hit's surface on the way, in [0, 1]
};

Walk walkOf(const Ray& r, const Surfel& s) {
    Walk w{r.end, {}, 0, 1};
    for (std::size_t i = 0; i < 3; i++) w.back[i] = r.origin[i] - r.end[i];
    w.length = std::hypot(w.back[0], w.back[1], w.back[2]);
    for (double& b : w.back) b /= w.length;
    if (s.flat)
        w.rise = std::abs(w.back[0] * static_cast<double>(s.normal[0]) +
                          w.back[1] * static_cast<double>(s.normal[1]) +
                          w.back[2] * static_cast<double>(s.normal[2]));
    return w;
}

}  // namespace

std::size_t markFree(const std::vector<KeptRay>& rays, const std::vector<Surfel>& surfels,
                     double radius, double resolution, FreeSpace& free) {
    free.clear();
    std::size_t balls = 0;
    const double per_cell = 1 / resolution, largest = radius * radius;
    for (std::size_t i = 0; i < rays.size(); i++) {
        const Walk w = walkOf(*rays[i].ray, surfels[i]);
        const double length = w.length * per_cell;
        for (double t = 1; t < length;) {
            const double ball = std::min(radius, kClearance * t * w.rise);
            if (ball >= kLeastBall) {
                balls++;
                const auto at = [&](std::size_t a) {
                    return static_cast<int32_t>(std::floor(w.end[a] * per_cell + w.back[a] * t));
                };
                free.mark({at(0), at(1), at(2)},
                          static_cast<uint16_t>(FreeSpace::kUnit * (largest - ball * ball)));
            }
            t += std::max(1.0, kStep * ball);
        }
    }
    return balls;
}

bool addEvidence(const BlockGrid& surface, const FreeSpace& free, double radius,
                 double max_evidence, BlockGrid& grid, EvidenceScratch& s) {
    KeyTable index;
    std::vector<ScanBlock> scan;
    s.where.clear();
    for (std::size_t i = 0; i < free.keys().size(); i++) {
        const uint64_t key = free.keys()[i];
        index.insert(key, static_cast<uint32_t>(i));
        s.where.push_back(unpackKey(key));
        scan.push_back({nullptr, free.plane(i).data()});
    }
    for (const auto& [place, block] : surface.sortedBlocks()) {
        const auto [i, added] = index.insert(packKey(place), static_cast<uint32_t>(scan.size()));
        if (added) s.where.push_back(place), scan.push_back({nullptr, nullptr});
        scan[i].surface = block->alpha.data();
    }

    // All that may run out of memory comes before the first sum is changed.
    const std::size_t n = scan.size();
    s.blocks.assign(n, nullptr);
    s.fresh.assign(n, nullptr);
    std::vector<char> reached(n, 0);
    grid.reserve(grid.blockCount() + n);
    for (std::size_t b = 0; b < n; b++) s.blocks[b] = grid.own(s.where[b]);
    tbb::parallel_for(std::size_t{0}, n, [&](std::size_t b) {
        if (s.blocks[b]) return;
        s.fresh[b] = std::make_shared<Block>();
        s.blocks[b] = s.fresh[b].get();
    });
    const auto bound = max_evidence > 0 ? static_cast<float>(max_evidence)
                                        : std::numeric_limits<float>::infinity();
    const auto inverse_limit = static_cast<float>(1 / (FreeSpace::kUnit * radius * radius));
    tbb::parallel_for(std::size_t{0}, n, [&](std::size_t b) {
        reached[b] = addBlock(scan[b], inverse_limit, bound, *s.blocks[b]);
    });
    bool changed = false;
    for (std::size_t b = 0; b < n; b++) {
        if (!reached[b]) continue;
        changed = true;
        if (s.fresh[b]) grid.adopt(s.where[b], std::move(s.fresh[b]));
    }
    s.fresh.clear();
    return changed;
}

}  // namespace akimap
