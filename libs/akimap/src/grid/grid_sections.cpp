// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "grid/grid_sections.h"

#include <algorithm>
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
static_assert(sizeof(Block) == 2 * Block::kCells * sizeof(float));
static_assert(std::is_trivially_copyable_v<Block> && std::is_trivially_copyable_v<BlockIndex>);

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
AKIMAP_MULTIVERSION const char* faultOf(const Block& block) {
    constexpr uint32_t kSign = 0x80000000u, kInfinity = 0x7f800000u;  // of an IEEE 754 float
    const auto* bytes = reinterpret_cast<const unsigned char*>(&block);
    uint32_t any = 0, overflow = 0;
    for (std::size_t i = 0; i < kWordsOf<Block>; i++) {
        uint32_t bits = 0;
        std::memcpy(&bits, bytes + i * sizeof bits, sizeof bits);
        any |= bits, overflow |= bits + (kSign - kInfinity);
    }
    if ((any | overflow) & kSign) return "a cell is negative or not finite";
    return any == 0 ? "a block without evidence" : nullptr;
}

}  // namespace

void writeGrid(const WriteBytes& out, const BlockGrid& grid) {
    const auto blocks = grid.sortedBlocks();
    SectionWriter places(out, kBlocksTag, Need::required, blocks.size() * sizeof(BlockIndex));
    writeInPieces<BlockIndex>(places, blocks.size(), kPlacesAtOnce,
                              [&](std::size_t i, BlockIndex& b) { b = blocks[i].index; });
    SectionWriter cells(out, kCellsTag, Need::required, blocks.size() * sizeof(Block));
    writeInPieces<Block>(cells, blocks.size(), kBlocksAtOnce, [&](std::size_t i, Block& block) {
        std::memcpy(&block, blocks[i].block, sizeof(Block));
    });
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
    if (section.left() / sizeof(Block) != blocks.size() || section.left() % sizeof(Block) != 0)
        throw CorruptMap("its cells are not those of its blocks");
    grid.reserve(blocks.size());
    const ReadBytes read = [&](void* bytes, std::size_t n) { section.read(bytes, n); };
    for (const BlockIndex& b : blocks) grid.adopt(b, readBlock(read));
    section.finish();
}

void checkPlace(const BlockIndex* previous, const BlockIndex& b) {
    if (!BlockGrid::isAddressable(b)) throw CorruptMap("a block lies outside the grid");
    if (previous && packKey(b) <= packKey(*previous))
        throw CorruptMap("its blocks are out of order");
}

std::shared_ptr<Block> readBlock(const ReadBytes& read) {
    const auto block = std::allocate_shared<Block>(Uninitialized<Block>());
    read(block.get(), sizeof(Block));
    swapUnlessLittleEndian(block.get(), kWordsOf<Block>);
    if (const char* fault = faultOf(*block)) throw CorruptMap(fault);
    return block;
}

}  // namespace akimap
