// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <akimap/AkiMap.h>

#include <string>

namespace akimap::test {

/** Share of the cells of two maps' files that are of the same kind. */
inline double alike(const std::string& a, const std::string& b) {
    const auto one = AkiMap::loadFromFile(a), other = AkiMap::loadFromFile(b);
    std::size_t same = 0, all = 0;
    const auto compare = [&](const AkiMap& x, const AkiMap& y, bool count_common) {
        x.forEachCell([&](const Cell& c) {
            const auto there = y.cell(c.x, c.y, c.z);
            if (there && !count_common) return;
            all++;
            same += there && kindOf(c.state) == kindOf(*there);
        });
    };
    compare(*one, *other, true);
    compare(*other, *one, false);
    return static_cast<double>(same) / static_cast<double>(all);
}

}  // namespace akimap::test
