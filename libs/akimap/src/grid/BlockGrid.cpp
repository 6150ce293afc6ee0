// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "grid/BlockGrid.h"

#include <algorithm>
#include <atomic>
#include <sstream>
#include <stdexcept>

namespace akimap {

bool Block::isEmpty() const {
    const auto positive = [](float v) { return v > 0; };
    return std::none_of(alpha.begin(), alpha.end(), positive) &&
           std::none_of(beta.begin(), beta.end(), positive);
}

BlockGrid::BlockGrid(double resolution) : resolution_(resolution) {
    if (resolution > 0 && std::isfinite(resolution)) return;
    std::ostringstream text;
    text << "resolution = " << resolution << ": must be finite and > 0";
    throw std::invalid_argument(text.str());
}

std::size_t BlockGrid::countCells() const {
    std::size_t n = 0;
    for (const Slot& s : blocks_)
        for (int i = 0; i < Block::kCells; i++) n += s.block->hasEvidence(i);
    return n;
}

std::size_t BlockGrid::memoryBytes() const {
    std::size_t surfaces = 0;
    for (const Slot& s : blocks_) surfaces += s.block->surface != nullptr;
    return sizeof(*this) + index_.memoryBytes() + blocks_.capacity() * sizeof(Slot) +
           blocks_.size() * sizeof(Block) + surfaces * sizeof(SurfaceSums);
}

Block* BlockGrid::own(const BlockIndex& b) {
    const uint32_t place = index_.find(packKey(b));
    if (place == KeyTable::kNone) return nullptr;
    std::shared_ptr<Block>& block = blocks_[place].block;
    if (block.use_count() > 1) block = std::make_shared<Block>(*block);
    // A copy that let go of it in another thread has read from it before.
    std::atomic_thread_fence(std::memory_order_acquire);
#ifdef __SANITIZE_THREAD__  // which sees no fences, but what copying a pointer does to its count
    const std::shared_ptr<Block> seen = block;
#endif
    return block.get();
}

void BlockGrid::reserve(std::size_t blocks) {
    if (blocks > blocks_.capacity())
        blocks_.reserve(std::max(blocks, blocks_.size() + blocks_.size() / 8));
    index_.reserve(blocks);
}

void BlockGrid::adopt(const BlockIndex& b, std::shared_ptr<Block> block) {
    reserve(blocks_.size() + 1);
    index_.insert(packKey(b), static_cast<uint32_t>(blocks_.size()));
    blocks_.push_back({packKey(b), std::move(block)});
}

void BlockGrid::clear() {
    *this = BlockGrid(resolution_);
}

std::vector<BlockGrid::PlacedBlock> BlockGrid::sortedBlocks() const {
    std::vector<std::pair<uint64_t, const Block*>> blocks;
    blocks.reserve(blocks_.size());
    for (const Slot& s : blocks_) blocks.emplace_back(s.key, s.block.get());
    std::sort(blocks.begin(), blocks.end());
    std::vector<PlacedBlock> sorted;
    sorted.reserve(blocks.size());
    for (const auto& [key, block] : blocks) sorted.push_back({unpackKey(key), block});
    return sorted;
}

}  // namespace akimap
