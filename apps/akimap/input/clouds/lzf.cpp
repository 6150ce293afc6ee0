// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "input/clouds/lzf.h"

#include <stdexcept>
#include <string>

namespace akimap::app {

namespace {

[[noreturn]] void refuse(std::size_t offset) {
    throw std::runtime_error("the compressed data are damaged at their byte " +
                             std::to_string(offset));
}

}  // namespace

std::vector<uint8_t> unpackLzf(const std::vector<uint8_t>& packed, std::size_t size) {
    std::vector<uint8_t> out;
    // No byte of a block can stand for more than 264/3 bytes: a damaged size must not eat memory.
    if (size / 88 > packed.size()) refuse(0);
    out.reserve(size);
    std::size_t i = 0;
    const auto next = [&] {
        if (i == packed.size()) refuse(i);
        return std::size_t{packed[i++]};
    };
    while (i < packed.size()) {
        const std::size_t control = next();
        if (control < 32) {  // a run of control + 1 literal bytes
            const std::size_t length = control + 1;
            if (length > packed.size() - i || length > size - out.size()) refuse(i);
            const auto start = packed.begin() + static_cast<std::ptrdiff_t>(i);
            out.insert(out.end(), start, start + static_cast<std::ptrdiff_t>(length));
            i += length;
            continue;
        }
        // A copy from earlier output: 3 bits of length (7: one more byte), 13 bits of distance.
        std::size_t length = (control >> 5) + 2;
        if (length == 9) length += next();
        const std::size_t distance = ((control & 31) << 8 | next()) + 1;
        if (distance > out.size() || length > size - out.size()) refuse(i);
        for (std::size_t n = 0; n < length; n++)  // may overlap itself, so byte by byte
            out.push_back(out[out.size() - distance]);
    }
    if (out.size() != size) refuse(i);
    return out;
}

}  // namespace akimap::app
