// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <array>
#include <cstddef>
#include <istream>
#include <optional>
#include <string>
#include <vector>

namespace akimap::app {

/** The text at the head of a PCD file. */
struct PcdHeader {
    enum class Data { ascii, binary, binary_compressed };
    struct Field {
        std::string name;
        std::size_t size = 4;    ///< [bytes] of one element
        char type = 'F';         ///< I, U or F
        std::size_t count = 1;   ///< elements
        std::size_t column = 0;  ///< elements before it in a line of ascii data
        std::size_t offset = 0;  ///< [bytes] before it in a binary point
    };

    std::vector<Field> fields;
    std::size_t points = 0;
    std::size_t columns = 0;         ///< numbers in a line of ascii data
    std::size_t point_size = 0;      ///< [bytes] of a binary point
    std::array<double, 3> origin{};  ///< [m] the translation of VIEWPOINT
    Data data = Data::ascii;
    std::size_t lines = 0;             ///< in the header; the data start behind them
    std::array<std::size_t, 3> xyz{};  ///< where x, y and z are among the fields
};

/** Reads up to and with the DATA line.
 * \exception std::runtime_error "line N: what is wrong" */
[[nodiscard]] PcdHeader readPcdHeader(std::istream& in);

}  // namespace akimap::app
