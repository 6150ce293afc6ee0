// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <algorithm>
#include <charconv>
#include <string_view>
#include <vector>

namespace akimap::app {

/** Reads the whole of `text` as one number, whatever the locale; false leaves `value` alone.
 * Takes a leading '+', "nan" and "inf" where T can hold them. */
template <class T>
[[nodiscard]] bool parseNumber(std::string_view text, T& value) {
    if (text.size() > 1 && text.front() == '+' && text[1] != '-') text.remove_prefix(1);
    const char* end = text.data() + text.size();
    T parsed{};
    const auto result = std::from_chars(text.data(), end, parsed);
    if (result.ec != std::errc() || result.ptr != end) return false;
    value = parsed;
    return true;
}

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

}  // namespace akimap::app
