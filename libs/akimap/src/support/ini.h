// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <algorithm>
#include <string>

namespace akimap {

/** An INI file's value without the comment and the blanks around it. */
[[nodiscard]] inline std::string withoutComment(const std::string& text) {
    constexpr const char* kBlanks = " \t\r\n";
    const std::string value = text.substr(0, std::min(text.find("//"), text.find_first_of(";#")));
    const auto begin = value.find_first_not_of(kBlanks);
    if (begin == std::string::npos) return "";
    return value.substr(begin, value.find_last_not_of(kBlanks) + 1 - begin);
}

}  // namespace akimap
