// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

// Map files are little endian, whatever the machine.

namespace akimap {

constexpr bool kLittleEndian = __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__;

template <class T>
[[nodiscard]] T loadLittleEndian(const void* bytes) {
    static_assert(std::is_unsigned_v<T>);
    T v = 0;
    if constexpr (kLittleEndian) {
        std::memcpy(&v, bytes, sizeof v);
    } else {
        for (std::size_t i = sizeof v; i-- > 0;)
            v = static_cast<T>(v << 8 | static_cast<const unsigned char*>(bytes)[i]);
    }
    return v;
}

template <class T>
void storeLittleEndian(void* bytes, T v) {
    static_assert(std::is_unsigned_v<T>);
    for (std::size_t i = 0; i < sizeof v; i++)
        static_cast<unsigned char*>(bytes)[i] = static_cast<unsigned char>(v >> 8 * i);
}

/** From the machine's order to the file's, or back. */
inline void swapUnlessLittleEndian(void* words, std::size_t count) {
    if constexpr (kLittleEndian) return;
    auto* bytes = static_cast<unsigned char*>(words);
    for (std::size_t i = 0; i < count; i++, bytes += sizeof(uint32_t)) {
        uint32_t word = 0;
        std::memcpy(&word, bytes, sizeof word);
        storeLittleEndian(bytes, word);
    }
}

}  // namespace akimap
