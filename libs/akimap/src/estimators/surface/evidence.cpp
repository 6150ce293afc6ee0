// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "estimators/surface/evidence.h"

#include <algorithm>
#include <cstring>
#include <limits>

namespace akimap {
namespace {
constexpr float kLeastSurface = 0.1f;  // of a, where nothing else is known of a cell
constexpr float kSurfaceWeight = 2;    // a surface counts as much as so many free spaces

/** What one scan says of a block: the sums of its surface kernels, and its power distances; either
 * may be missing. */
struct ScanBlock {
    const float* surface;
    const uint16_t* power;
};

/** Scales both down where they gained and are more than the bound in sum, but not to denormal
 * numbers, which are slow. */
AKIMAP_INLINE void boundSum(RowMask gains, float bound, Row& alpha, Row& beta) {
    constexpr Row one = {1, 1, 1, 1, 1, 1, 1, 1};
    const Row sum = alpha + beta;
    const RowMask over = gains & (sum > bound);
    if (!bitsOf(over)) return;
    const Row scale = over ? bound / sum : one;
    for (Row* v : {&alpha, &beta}) {
        const Row least = *v < 1e-20f ? *v : 1e-20f * one, scaled = *v * scale;
        *v = scaled > least ? scaled : least;
    }
}

/** Adds one scan to a block, whose cells are not read but written if it is fresh.
 * \return whether a cell of it gained evidence */
template <bool fresh>
AKIMAP_INLINE bool addRows(const ScanBlock& scan, float inverse_limit, float bound, Block& block) {
    using Powers = uint16_t __attribute__((vector_size(16)));
    constexpr Row one = {1, 1, 1, 1, 1, 1, 1, 1};
    RowMask gained{};
    for (int i = 0; i < Block::kCells; i += Block::kSide) {
        Row alpha{}, beta{};
        if constexpr (!fresh)
            alpha = loadRow(block.alpha.data() + i), beta = loadRow(block.beta.data() + i);
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
        const RowMask gains = (a > 0.0f) | (b > 0.0f);
        gained |= gains;
        alpha += kSurfaceWeight * a, beta += b;
        boundSum(gains, bound, alpha, beta);
        storeRow(block.alpha.data() + i, alpha);
        storeRow(block.beta.data() + i, beta);
    }
    return bitsOf(gained != 0) != 0;
}

AKIMAP_MULTIVERSION
bool addBlock(const ScanBlock& scan, float inverse_limit, float bound, bool fresh, Block& block) {
    return fresh ? addRows<true>(scan, inverse_limit, bound, block)
                 : addRows<false>(scan, inverse_limit, bound, block);
}

/** Lists the blocks that the scan says anything of. */
void listBlocks(const BinnedKernels& kernels, const FreeBalls& free,
                std::vector<EvidenceBlock>& blocks) {
    constexpr uint32_t kNone = KeyTable::kNone;
    blocks.clear();
    for (uint32_t i = 0; i < free.keys().size(); i++) blocks.push_back({free.keys()[i], kNone, i});
    for (uint32_t i = 0; i < kernels.keys.size(); i++) {
        const uint32_t b = free.find(kernels.keys[i]);
        if (b == kNone)
            blocks.push_back({kernels.keys[i], i, kNone});
        else
            blocks[b].kernels = i;
    }
}

}  // namespace

bool addEvidence(const CellIndex& anchor, const BinnedKernels& kernels, const ScanFreeSpace& free,
                 double max_evidence, BlockGrid& grid, EvidenceWorkspace& w) {
    listBlocks(kernels, free.balls, w.blocks);
    const auto bound = max_evidence > 0 ? static_cast<float>(max_evidence)
                                        : std::numeric_limits<float>::infinity();
    const auto inverse_limit = static_cast<float>(1 / (kPowerUnit * free.radius * free.radius));
    const auto placeOf = [&](std::size_t b) { return blockInMap(w.blocks[b].key, anchor); };
    return w.update.run(
        grid, w.blocks.size(), placeOf, [&](std::size_t b, Block& block, bool fresh) {
            alignas(32) float surface[Block::kCells];
            const EvidenceBlock& of = w.blocks[b];
            ScanBlock scan{nullptr, nullptr};
            if (of.free != KeyTable::kNone) scan.power = free.balls.block(of.free).data();
            if (of.kernels != KeyTable::kNone) {
                std::fill_n(surface, Block::kCells, 0.0f);
                if (addKernels(kernels, of.kernels, kernels.kernels.size(), surface, nullptr))
                    scan.surface = surface;
            }
            return addBlock(scan, inverse_limit, bound, fresh, block);
        });
}

}  // namespace akimap
