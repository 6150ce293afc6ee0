// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <string>
#include <vector>

namespace akimap {

/** Letters added, left out, changed, or swapped with their neighbour, whatever their case. */
[[nodiscard]] inline std::size_t editsBetween(const std::string& a, const std::string& b) {
    const auto same = [](char x, char y) {
        return std::tolower(static_cast<unsigned char>(x)) ==
               std::tolower(static_cast<unsigned char>(y));
    };
    std::vector<std::vector<std::size_t>> edits(a.size() + 1,
                                                std::vector<std::size_t>(b.size() + 1));
    for (std::size_t i = 0; i <= a.size(); i++) edits[i][0] = i;
    for (std::size_t j = 0; j <= b.size(); j++) edits[0][j] = j;
    for (std::size_t i = 1; i <= a.size(); i++)
        for (std::size_t j = 1; j <= b.size(); j++) {
            const std::size_t changed = edits[i - 1][j - 1] + (same(a[i - 1], b[j - 1]) ? 0 : 1);
            edits[i][j] = std::min({edits[i - 1][j] + 1, edits[i][j - 1] + 1, changed});
            if (i > 1 && j > 1 && same(a[i - 1], b[j - 2]) && same(a[i - 2], b[j - 1]))
                edits[i][j] = std::min(edits[i][j], edits[i - 2][j - 2] + 1);
        }
    return edits[a.size()][b.size()];
}

/** The name that a mistyped one is likely meant to be; empty if it is like none of them. */
[[nodiscard]] inline std::string similarTo(const std::string& text,
                                           const std::vector<std::string>& names) {
    std::string closest;
    std::size_t fewest = std::min<std::size_t>(3, text.size() / 3) + 1;
    for (const std::string& name : names) {
        const std::size_t edits = editsBetween(text, name);
        if (edits < fewest) fewest = edits, closest = name;
    }
    return closest;
}

/** "; did you mean NAME?", or nothing. */
[[nodiscard]] inline std::string didYouMean(const std::string& text,
                                            const std::vector<std::string>& names) {
    const std::string name = similarTo(text, names);
    return name.empty() ? "" : "; did you mean " + name + "?";
}

}  // namespace akimap
