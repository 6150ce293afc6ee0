// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace akimap::app {

/** Unpacks an LZF block, the compression of PCD's binary_compressed.
 * \param size bytes that the block must unpack to
 * \exception std::runtime_error naming the offset [bytes] in the block where it is damaged */
[[nodiscard]] std::vector<uint8_t> unpackLzf(const std::vector<uint8_t>& packed, std::size_t size);

}  // namespace akimap::app
