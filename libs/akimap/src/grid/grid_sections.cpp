// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "grid/grid_sections.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <memory>
#include <type_traits>

#include "numeric/rows.h"
#include "support/little_endian.h"

namespace akimap {
namespace {

using BlockIndex = BlockGrid::BlockIndex;

// Both are in files as they are in memory: words of 32 bits, alpha before beta.
static_assert(sizeof(BlockIndex) == 3 * sizeof(int32_t));
static_assert(sizeof(CellSums) == 2 * Block::kCells * sizeof(float));
static_assert(std::is_trivially_copyable_v<CellSums> && std::is_trivially_copyable_v<BlockIndex>);

/** Few large pieces: MRPT's memory stream, through which particles are copied, grows at each. */
constexpr std::size_t kBlocksAtOnce = 64;
constexpr std::size_t kPlacesAtOnce = 4096;

template <class T>
constexpr std::size_t kWordsOf = sizeof(T) / sizeof(uint32_t);

/** Writes items as they are in memory; copyTo(i, T&) gives the i-th. */
template <class T, class CopyTo>
void writeInPieces(SectionWriter& section, std::size_t count, std::size_t at_once,
                   CopyTo&& copyTo) {
    const std::unique_ptr<T[]> piece(new T[std::min(count, at_once)]);
    for (std::size_t first = 0; first < count; first += at_once) {
        const std::size_t n = std::min(at_once, count - first);
        for (std::size_t i = 0; i < n; i++) copyTo(first + i, piece[i]);
        swapUnlessLittleEndian(piece.get(), n * kWordsOf<T>);
        section.write(piece.get(), n * sizeof(T));
    }
    section.finish();
}

/** A block's surface sums in a file. */
struct StoredSurface {
    uint32_t block;                                        ///< its number among the blocks
    std::array<std::array<float, Block::kCells>, 4> sums;  ///< weight, place, square, through

    StoredSurface() = default;
    StoredSurface(uint32_t number, const SurfaceSums& s)
        : block(number), sums{s.weight, s.place, s.square, s.through} {}
    /** Only a place may be negative. \return whether all others are, and all are finite */
    [[nodiscard]] bool isSound() const {
        bool sound = true;
        for (std::size_t k = 0; k < sums.size(); k++)
            for (const float v : sums[k]) sound &= std::isfinite(v) && (v >= 0 || k == 1);
        return sound;
    }
};
static_assert(sizeof(StoredSurface) == sizeof(uint32_t) + 4 * Block::kCells * sizeof(float));
static_assert(std::is_trivially_copyable_v<StoredSurface>);

/** Lets std::allocate_shared() make, in one allocation, what is read into at once: not zeroed. */
template <class T>
struct Uninitialized : std::allocator<T> {
    template <class U>
    struct rebind {
        using other = Uninitialized<U>;
    };
    Uninitialized() = default;
    template <class U>
    Uninitialized(const Uninitialized<U>&) {}
    template <class U>
    void construct(U* place) {
        ::new (static_cast<void*>(place)) U;
    }
};

/** What is wrong with a block's sums, if anything: they are finite, >= 0 and not all 0. On bits and
 * without a way out, so that it runs on whole rows. */
AKIMAP_MULTIVERSION const char* faultOf(const CellSums& block) {
    constexpr uint32_t kSign = 0x80000000u, kInfinity = 0x7f800000u;  // of an IEEE 754 float
    const auto* bytes = reinterpret_cast<const unsigned char*>(&block);
    uint32_t any = 0, overflow = 0;
    for (std::size_t i = 0; i < kWordsOf<CellSums>; i++) {
        uint32_t bits = 0;
        std::memcpy(&bits, bytes + i * sizeof bits, sizeof bits);
        any |= bits, overflow |= bits + (kSign - kInfinity);
    }
    if ((any | overflow) & kSign) return "a cell is negative or not finite";
    return any == 0 ? "a block without evidence" : nullptr;
}

void writeSurfaces(const WriteBytes& out, const std::vector<BlockGrid::PlacedBlock>& blocks) {
    std::vector<uint32_t> with;
    for (uint32_t i = 0; i < blocks.size(); i++)
        if (blocks[i].block->surface) with.push_back(i);
    if (with.empty()) return;
    SectionWriter section(out, kSurfacesTag, Need::optional, with.size() * sizeof(StoredSurface));
    writeInPieces<StoredSurface>(section, with.size(), kBlocksAtOnce,
                                 [&](std::size_t i, StoredSurface& s) {
                                     s = {with[i], *blocks[with[i]].block->surface};
                                 });
}

}  // namespace

void writeGrid(const WriteBytes& out, const BlockGrid& grid) {
    const auto blocks = grid.sortedBlocks();
    SectionWriter places(out, kBlocksTag, Need::required, blocks.size() * sizeof(BlockIndex));
    writeInPieces<BlockIndex>(places, blocks.size(), kPlacesAtOnce,
                              [&](std::size_t i, BlockIndex& b) { b = blocks[i].index; });
    SectionWriter cells(out, kCellsTag, Need::required, blocks.size() * sizeof(CellSums));
    writeInPieces<CellSums>(cells, blocks.size(), kBlocksAtOnce,
                            [&](std::size_t i, CellSums& block) { block = *blocks[i].block; });
    writeSurfaces(out, blocks);
}

std::vector<BlockIndex> readBlocks(SectionReader& section) {
    std::vector<BlockIndex> blocks;
    while (section.left() > 0) {
        const std::size_t at = blocks.size();
        const std::size_t n =
            std::clamp<uint64_t>(section.left() / sizeof(BlockIndex), 1, kPlacesAtOnce);
        blocks.resize(at + n);
        section.read(&blocks[at], n * sizeof(BlockIndex));
        swapUnlessLittleEndian(&blocks[at], n * kWordsOf<BlockIndex>);
    }
    section.finish();
    for (std::size_t i = 0; i < blocks.size(); i++)
        checkPlace(i > 0 ? &blocks[i - 1] : nullptr, blocks[i]);
    return blocks;
}

void readCells(SectionReader& section, const std::vector<BlockIndex>& blocks, BlockGrid& grid) {
    if (section.left() / sizeof(CellSums) != blocks.size() ||
        section.left() % sizeof(CellSums) != 0)
        throw CorruptMap("its cells are not those of its blocks");
    grid.reserve(blocks.size());
    const ReadBytes read = [&](void* bytes, std::size_t n) { section.read(bytes, n); };
    for (const BlockIndex& b : blocks) grid.adopt(b, readBlock(read));
    section.finish();
}

void readSurfaces(SectionReader& section, const std::vector<BlockIndex>& blocks, BlockGrid& grid) {
    StoredSurface s;
    for (uint64_t least = 0; section.left() > 0; least = s.block + uint64_t{1}) {
        section.read(&s, sizeof s);
        swapUnlessLittleEndian(&s, kWordsOf<StoredSurface>);
        if (s.block < least || s.block >= blocks.size())
            throw CorruptMap("surfaces of a block that is not there, or out of order");
        if (!s.isSound()) throw CorruptMap("a surface is negative or not finite");
        grid.own(blocks[s.block])->surface =
            std::make_unique<SurfaceSums>(SurfaceSums{s.sums[0], s.sums[1], s.sums[2], s.sums[3]});
    }
    section.finish();
}

void checkPlace(const BlockIndex* previous, const BlockIndex& b) {
    if (!BlockGrid::isAddressable(b)) throw CorruptMap("a block lies outside the grid");
    if (previous && packKey(b) <= packKey(*previous))
        throw CorruptMap("its blocks are out of order");
}

std::shared_ptr<Block> readBlock(const ReadBytes& read) {
    const auto block = std::allocate_shared<Block>(Uninitialized<Block>());
    CellSums& sums = *block;
    read(&sums, sizeof sums);
    swapUnlessLittleEndian(&sums, kWordsOf<CellSums>);
    if (const char* fault = faultOf(*block)) throw CorruptMap(fault);
    return block;
}

}  // namespace akimap
