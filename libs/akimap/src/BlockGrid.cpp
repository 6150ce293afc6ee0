// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <akimap/BlockGrid.h>

#include <algorithm>
#include <stdexcept>

namespace akimap {

bool Block::isEmpty() const {
    const auto positive = [](float v) { return v > 0; };
    return std::none_of(alpha.begin(), alpha.end(), positive) &&
           std::none_of(beta.begin(), beta.end(), positive);
}

BlockGrid::BlockGrid(double resolution) : resolution_(resolution) {
    if (!(resolution > 0) || !std::isfinite(resolution))
        throw std::invalid_argument("resolution must be finite and > 0, not " +
                                    std::to_string(resolution));
}

BlockGrid::BlockGrid(const BlockGrid& o) : resolution_(o.resolution_), index_(o.index_) {
    blocks_.reserve(o.blocks_.size());
    for (const Slot& s : o.blocks_) blocks_.push_back({s.key, std::make_unique<Block>(*s.block)});
}

BlockGrid& BlockGrid::operator=(const BlockGrid& o) {
    if (this != &o) *this = BlockGrid(o);
    return *this;
}

std::size_t BlockGrid::countCells() const {
    std::size_t n = 0;
    for (const Slot& s : blocks_)
        for (int i = 0; i < Block::kCells; i++) n += s.block->hasEvidence(i);
    return n;
}

std::size_t BlockGrid::memoryBytes() const {
    return sizeof(*this) + index_.memoryBytes() + blocks_.capacity() * sizeof(Slot) +
           blocks_.size() * sizeof(Block);
}

bool BlockGrid::covers(double x, double y, double z) const {
    const double limit = kMaxCell * resolution_;
    return std::abs(x) < limit && std::abs(y) < limit && std::abs(z) < limit;
}

const Block* BlockGrid::find(const BlockIndex& b) const {
    const uint32_t place = index_.find(packKey(b));
    return place == KeyTable::kNone ? nullptr : blocks_[place].block.get();
}

Block* BlockGrid::find(const BlockIndex& b) {
    return const_cast<Block*>(std::as_const(*this).find(b));
}

void BlockGrid::adopt(const BlockIndex& b, std::unique_ptr<Block> block) {
    index_.insert(packKey(b), static_cast<uint32_t>(blocks_.size()));
    blocks_.push_back({packKey(b), std::move(block)});
}

void BlockGrid::clear() {
    *this = BlockGrid(resolution_);
}

std::vector<BlockGrid::BlockIndex> BlockGrid::sortedBlocks() const {
    std::vector<uint64_t> keys;
    keys.reserve(blocks_.size());
    for (const Slot& s : blocks_) keys.push_back(s.key);
    std::sort(keys.begin(), keys.end());
    std::vector<BlockIndex> sorted;
    sorted.reserve(keys.size());
    for (const uint64_t k : keys) sorted.push_back(unpackKey(k));
    return sorted;
}

}  // namespace akimap
