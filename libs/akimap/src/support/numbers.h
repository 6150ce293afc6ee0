// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <charconv>
#include <string>
#include <string_view>

// Numbers as text, the same in every locale.

namespace akimap {

/** Reads the whole of `text` as one number; false leaves `value` alone.
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

/** The fewest digits that read back the same. */
template <class T>
[[nodiscard]] std::string numberText(T v) {
    char text[32];
    return {text, std::to_chars(text, text + sizeof text, v).ptr};
}

}  // namespace akimap
