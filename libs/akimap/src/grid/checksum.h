// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace akimap {

/** Checksum of a map file's sections, doc/format.md: many lanes side by side, so that it runs as
 * fast as memory. Any single changed bit changes it: each step maps the states one to one. Not
 * against forgery.
 * Bytes may be added in pieces of any size; the pieces do not matter. */
class Checksum {
 public:
    static constexpr std::size_t kLanes = 32;
    static constexpr std::size_t kStride = kLanes * sizeof(uint32_t);  ///< [bytes]

    Checksum();
    void add(const void* bytes, std::size_t size);
    /** Of all that was added so far. */
    [[nodiscard]] uint64_t value() const;

 private:
    std::array<uint32_t, kLanes> lanes_;
    std::array<unsigned char, kStride> rest_;  // of the bytes, what fills no stride yet
    uint64_t size_ = 0;
};

[[nodiscard]] inline uint64_t checksumOf(const void* bytes, std::size_t size) {
    Checksum sum;
    sum.add(bytes, size);
    return sum.value();
}

}  // namespace akimap
