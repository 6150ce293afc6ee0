// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace akimap {

/** Hash table from 64-bit keys to 32-bit values: open addressing with linear probing, at most
 * half full. No erase. Concurrent const calls are safe. */
class KeyTable {
 public:
    static constexpr uint32_t kNone = UINT32_MAX;

    /** The key's value, kNone if absent. */
    [[nodiscard]] uint32_t find(uint64_t key) const {
        if (slots_.empty()) return kNone;
        for (std::size_t i = home(key);; i = (i + 1) & mask_) {
            if (slots_[i].value == kNone) return kNone;
            if (slots_[i].key == key) return slots_[i].value;
        }
    }

    /** The value already there, or `value` put there now; second: whether it was put. */
    std::pair<uint32_t, bool> insert(uint64_t key, uint32_t value) {
        reserve(size_ + 1);
        std::size_t i = home(key);
        for (; slots_[i].value != kNone; i = (i + 1) & mask_)
            if (slots_[i].key == key) return {slots_[i].value, false};
        slots_[i] = {key, value};
        ++size_;
        return {value, true};
    }

    /** Makes room for so many keys in all: insert() then allocates nothing. */
    void reserve(std::size_t keys) {
        while (2 * keys > slots_.size()) grow();
    }

    /** Empties the table and keeps its memory. */
    void clear() {
        for (Slot& s : slots_) s.value = kNone;
        size_ = 0;
    }
    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] std::size_t memoryBytes() const { return slots_.capacity() * sizeof(Slot); }

 private:
    struct Slot {
        uint64_t key = 0;
        uint32_t value = kNone;
    };

    /** The key's first place: the highest bits of its product with 2^64 over the golden ratio,
     * which depend on all of its bits (Knuth, The Art of Computer Programming 3, 6.4). */
    [[nodiscard]] std::size_t home(uint64_t key) const {
        return static_cast<std::size_t>(key * 0x9e3779b97f4a7c15u >> shift_);
    }
    void grow() {
        std::vector<Slot> old(slots_.empty() ? 64 : slots_.size() * 2);
        old.swap(slots_);
        mask_ = slots_.size() - 1;
        for (shift_ = 64; std::size_t{1} << (64 - shift_) < slots_.size();) shift_--;
        size_ = 0;
        for (const Slot& s : old)
            if (s.value != kNone) insert(s.key, s.value);
    }

    std::vector<Slot> slots_;
    std::size_t mask_ = 0, size_ = 0;
    int shift_ = 0;  // 64 less the bits of mask_
};

}  // namespace akimap
