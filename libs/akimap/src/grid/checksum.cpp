// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "grid/checksum.h"

#include <algorithm>
#include <cstring>

#include "numeric/rows.h"
#include "support/little_endian.h"

namespace akimap {
namespace {

using Lanes = std::array<uint32_t, Checksum::kLanes>;

/** Takes whole strides. The multiplier 2^11 + 1 is a shift and an addition, which plain x86-64 has
 * for whole registers too; the lanes are a local copy, so that they stay in registers. */
AKIMAP_MULTIVERSION void addStrides(Lanes& lanes, const unsigned char* bytes, std::size_t strides) {
    Lanes h = lanes;
    for (; strides > 0; --strides, bytes += Checksum::kStride) {
        for (std::size_t i = 0; i < Checksum::kLanes; i++) {
            uint32_t x = h[i] ^ loadLittleEndian<uint32_t>(bytes + sizeof(uint32_t) * i);
            x += x << 11;
            h[i] = x ^ x >> 15;
        }
    }
    lanes = h;
}

}  // namespace

Checksum::Checksum() {
    for (std::size_t i = 0; i < kLanes; i++)
        lanes_[i] = static_cast<uint32_t>(i + 1) * 0x9e3779b1u;  // exchanged lanes must show
}

void Checksum::add(const void* bytes, std::size_t size) {
    const auto* from = static_cast<const unsigned char*>(bytes);
    if (const std::size_t held = size_ % kStride; held > 0) {
        const std::size_t n = std::min(size, kStride - held);
        std::memcpy(rest_.data() + held, from, n);
        size_ += n, from += n, size -= n;
        if (size_ % kStride != 0) return;
        addStrides(lanes_, rest_.data(), 1);
    }
    const std::size_t strides = size / kStride;
    addStrides(lanes_, from, strides);
    std::memcpy(rest_.data(), from + strides * kStride, size - strides * kStride);
    size_ += size;
}

uint64_t Checksum::value() const {
    Lanes lanes = lanes_;
    if (const std::size_t held = size_ % kStride; held > 0) {
        auto last = rest_;
        std::fill(last.begin() + static_cast<std::ptrdiff_t>(held), last.end(), '\0');
        addStrides(lanes, last.data(), 1);
    }
    uint64_t sum = size_;
    for (const uint32_t lane : lanes) {
        sum = (sum ^ lane) * 0x9e3779b97f4a7c15u;
        sum ^= sum >> 32;
    }
    return sum;
}

}  // namespace akimap
