// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "estimators/surface/evidence.h"

#include <algorithm>
#include <cstring>
#include <limits>

#include "estimators/surface/cell_evidence.h"

namespace akimap {
namespace {
constexpr float kInferred = 0.3f;       // f between rays that passed, in the midst of them
constexpr float kInferredLater = 0.6f;  // of each later scan, where surfaces were measured
constexpr float kLeastInferred = 1e-3f;
constexpr float kBetween = 0.5f;      // f between rays, of each scan, far from any surface; and
constexpr float kMostBefore = 1;      // what all of that counts once a surface comes near
constexpr float kSeenThrough = 0.2f;  // of a surface, where rays passed and none ended

/** What one scan says of a block; any may be missing. */
struct ScanBlock {
    const PatchSums* patches = nullptr;
    const uint16_t* power = nullptr;
    const uint8_t* passes = nullptr;
};

AKIMAP_INLINE Row bytesAt(const uint8_t* bytes) {
    using Bytes = uint8_t __attribute__((vector_size(8)));
    Bytes b;
    std::memcpy(&b, bytes, sizeof b);
    return __builtin_convertvector(b, Row);
}
AKIMAP_INLINE Row wordsAt(const uint16_t* words) {
    using Words = uint16_t __attribute__((vector_size(16)));
    Words w;
    std::memcpy(&w, words, sizeof w);
    return __builtin_convertvector(w, Row);
}

struct RaysRow {
    Row passes;  ///< how many passed
    Row near;    ///< 1 on a ray, 0 as far from it as free space reaches
};
AKIMAP_INLINE RaysRow raysAt(const ScanBlock& scan, int i, float inverse_limit) {
    if (!scan.power) return RaysRow{{}, {}};
    const Row b = kOneRow - wordsAt(scan.power + i) * inverse_limit;
    return {bytesAt(scan.passes + i), keep(b > 0.0f, b)};
}

/** Adds to the sums of eight cells what the scan says of them. \return which gained */
AKIMAP_INLINE RowMask addScan(const ScanBlock& scan, int i, float inverse_limit, CellSumsRow& s) {
    const auto [passes, near] = raysAt(scan, i, inverse_limit);
    const RowMask passed = passes > 0.0f;
    RowMask on_surface{};
    Row through = keep(passed, kOneRow);
    if (scan.patches) {
        const Row sum = loadRow(scan.patches->weight + i),
                  returns = loadRow(scan.patches->returns + i);
        const RowMask measured = sum > 0.0f, ended = returns > 0.0f;
        on_surface = measured & (~passed | ended);
        const Row w = keep(measured, (sum < kOneRow ? sum : kOneRow) *
                                         (on_surface ? kOneRow : kSeenThrough * kOneRow));
        const Row d = loadRow(scan.patches->place + i) / (measured ? sum : kOneRow);
        s.weight += w, s.place += w * d, s.square += w * d * d;
        through = ended ? passes / (passes + returns) : through;
    }
    // Between rays f is bounded as long as nothing else is known, and slowly wins over surfaces
    // that no scan confirms: a passing ray meets few cells of what has moved away.
    const Row near2 = near * near, near8 = (near2 * near2) * (near2 * near2);
    const Row inferred = kInferred * near2;
    const RowMask between = ~passed & ~on_surface, first = between & (inferred > s.through),
                  later = between & ~first & (s.weight > 0.0f) & (near8 > kLeastInferred);
    s.through = first ? inferred : s.through + (later ? kInferredLater * near8 : through);
    return on_surface | passed | first | later;
}

/** Scales down what is more than the bound in sum. */
AKIMAP_INLINE void bound(RowMask gained, float most, CellSumsRow& s, EvidenceRow& e) {
    const Row sum = e.alpha + e.beta;
    const RowMask over = gained & (sum > most);
    if (!bitsOf(over)) return;
    const Row scale = over ? most / sum : kOneRow;
    for (Row* v : {&s.weight, &s.place, &s.square, &s.through, &e.alpha, &e.beta}) {
        const Row scaled = *v * scale;  // not down to denormal numbers, which are slow
        *v = keep((RowMask)((scaled > 1e-20f) | (scaled < -1e-20f)), scaled);
    }
}

AKIMAP_INLINE CellSumsRow sumsAt(const SurfaceSums& s, int i) {
    return {loadRow(s.weight.data() + i), loadRow(s.place.data() + i), loadRow(s.square.data() + i),
            loadRow(s.through.data() + i)};
}
AKIMAP_INLINE void store(const CellSumsRow& row, int i, SurfaceSums& s) {
    storeRow(s.weight.data() + i, row.weight), storeRow(s.place.data() + i, row.place);
    storeRow(s.square.data() + i, row.square), storeRow(s.through.data() + i, row.through);
}

/** Adds a scan to a block near surfaces. \return whether a cell of it gained evidence */
AKIMAP_INLINE bool addToSurface(const ScanBlock& scan, float inverse_limit, float most,
                                SurfaceSums& sums, Block& block) {
    RowMask any{};
    for (int i = 0; i < Block::kCells; i += Block::kSide) {
        CellSumsRow s = sumsAt(sums, i);
        const RowMask gained = addScan(scan, i, inverse_limit, s);
        if (!bitsOf(gained)) continue;
        any |= gained;
        const EvidenceRow now = evidenceOf(s);
        EvidenceRow e{loadRow(block.alpha.data() + i), loadRow(block.beta.data() + i)};
        e = {gained ? now.alpha : e.alpha, gained ? now.beta : e.beta};
        bound(gained, most, s, e);
        store(s, i, sums);
        storeRow(block.alpha.data() + i, e.alpha), storeRow(block.beta.data() + i, e.beta);
    }
    return bitsOf(any != 0) != 0;
}

/** The same far from any surface, where all evidence is f: what lies between rays counts, too. */
AKIMAP_INLINE bool addToFree(const ScanBlock& scan, float inverse_limit, float most, Block& block) {
    RowMask any{};
    for (int i = 0; i < Block::kCells; i += Block::kSide) {
        const RaysRow rays = raysAt(scan, i, inverse_limit);
        const Row before = loadRow(block.beta.data() + i);
        const Row through = rays.passes > 0.0f ? kOneRow : kBetween * rays.near * rays.near;
        const RowMask gained = through > 0.0f;
        CellSumsRow s{{}, {}, {}, before * (1 / kThroughWeight) + through};
        any |= gained;
        EvidenceRow e{{}, gained ? kThroughWeight * s.through : before};
        if (bitsOf(gained & (e.beta > most))) {
            e.alpha = loadRow(block.alpha.data() + i);
            bound(gained, most, s, e);
            storeRow(block.alpha.data() + i, e.alpha);
        }
        storeRow(block.beta.data() + i, e.beta);
    }
    return bitsOf(any != 0) != 0;
}

AKIMAP_MULTIVERSION
bool addBlock(const ScanBlock& scan, float inverse_limit, float most, Block& block) {
    return block.surface ? addToSurface(scan, inverse_limit, most, *block.surface, block)
                         : addToFree(scan, inverse_limit, most, block);
}

/** Gives a block that surfaces come near to the sums that its evidence follows from. */
void addSurfaceSums(Block& block) {
    auto sums = std::make_unique<SurfaceSums>();
    for (std::size_t i = 0; i < Block::kCells; i++) {
        sums->weight[i] = block.alpha[i] / kSurfaceWeight;
        const float through = block.beta[i] / kThroughWeight;
        // Where an older map had a surface all of it counts, as the surface does.
        sums->through[i] = block.alpha[i] > 0 ? through : std::min(through, kMostBefore);
    }
    block.surface = std::move(sums);
}

/** Lists the blocks that the scan says anything of. */
void listBlocks(const BinnedPatches& patches, const FreeBalls& free,
                std::vector<EvidenceBlock>& blocks) {
    constexpr uint32_t kNone = KeyTable::kNone;
    blocks.clear();
    for (uint32_t i = 0; i < free.keys().size(); i++) blocks.push_back({free.keys()[i], kNone, i});
    for (uint32_t i = 0; i < patches.keys.size(); i++) {
        const uint32_t b = free.find(patches.keys[i]);
        if (b == kNone)
            blocks.push_back({patches.keys[i], i, kNone});
        else
            blocks[b].patches = i;
    }
}

}  // namespace

bool addEvidence(const CellIndex& anchor, const BinnedPatches& patches, const ScanFreeSpace& free,
                 double max_evidence, BlockGrid& grid, EvidenceWorkspace& w) {
    constexpr uint32_t kNone = KeyTable::kNone;
    listBlocks(patches, free.balls, w.blocks);
    const auto most = max_evidence > 0 ? static_cast<float>(max_evidence)
                                       : std::numeric_limits<float>::infinity();
    const auto inverse_limit = static_cast<float>(1 / (kPowerUnit * free.radius * free.radius));
    const auto placeOf = [&](std::size_t b) { return blockInMap(w.blocks[b].key, anchor); };
    const auto equip = [&](std::size_t b, Block& block) {
        if (w.blocks[b].patches != kNone && !block.surface) addSurfaceSums(block);
    };
    return w.update.run(grid, w.blocks.size(), placeOf, equip, [&](std::size_t b, Block& block) {
        const EvidenceBlock& of = w.blocks[b];
        PatchSums sums;
        ScanBlock scan;
        if (of.free != kNone)
            scan.power = free.balls.block(of.free).data(),
            scan.passes = free.balls.passes(of.free).data();
        if (of.patches != kNone) sumPatches(patches, of.patches, sums), scan.patches = &sums;
        return addBlock(scan, inverse_limit, most, block);
    });
}

}  // namespace akimap
