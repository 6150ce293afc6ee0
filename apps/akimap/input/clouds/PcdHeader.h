// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <cstddef>
#include <istream>
#include <optional>
#include <string>
#include <vector>

#include "input/clouds/PointFields.h"

namespace akimap::app {

/** The text at the head of a PCD file. */
struct PcdHeader {
    enum class Data { ascii, binary, binary_compressed };

    std::vector<PointField> fields;
    std::size_t points = 0;
    std::size_t columns = 0;     ///< numbers in a line of ascii data
    std::size_t point_size = 0;  ///< [bytes] of a binary point
    std::optional<PcdViewpoint> viewpoint;
    Data data = Data::ascii;
    std::size_t lines = 0;  ///< in the header; the data start behind them
};

/** Reads up to and with the DATA line.
 * \exception std::runtime_error "line N: what is wrong" */
[[nodiscard]] PcdHeader readPcdHeader(std::istream& in);

}  // namespace akimap::app
