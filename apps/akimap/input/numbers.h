// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "support/numbers.h"

namespace akimap::app {

/** The words of a line, parted by blanks, tabs and a DOS line's '\r'. Reuses `words`. */
inline void splitWords(std::string_view line, std::vector<std::string_view>& words) {
    constexpr std::string_view blanks = " \t\r";
    words.clear();
    for (auto start = line.find_first_not_of(blanks); start != std::string_view::npos;) {
        const auto end = std::min(line.find_first_of(blanks, start), line.size());
        words.push_back(line.substr(start, end - start));
        start = line.find_first_not_of(blanks, end);
    }
}

/** The numbers of a text, parted by blanks, commas and ends of lines.
 * \exception std::runtime_error naming a word that is not a finite number */
inline std::vector<double> finiteNumbersOf(std::string text) {
    for (char& c : text)
        if (c == ',' || c == '\n') c = ' ';
    std::vector<std::string_view> words;
    splitWords(text, words);
    std::vector<double> numbers;
    for (const auto word : words) {
        double value = 0;
        if (!parseNumber(word, value) || !std::isfinite(value))
            throw std::runtime_error("'" + std::string(word) + "' is not a finite number");
        numbers.push_back(value);
    }
    return numbers;
}

}  // namespace akimap::app
