// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace akimap::app {

/** The q-quantile by nearest rank: the least of the values that at least the share q of them does
 * not exceed. O(n). Takes its argument by value because it sorts partly.
 * NaN if there are none. \pre q is in [0, 1] */
template <class T>
[[nodiscard]] double quantile(std::vector<T> values, double q) {
    if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
    const auto rank = static_cast<std::size_t>(std::ceil(q * static_cast<double>(values.size())));
    const auto nth =
        values.begin() + static_cast<std::ptrdiff_t>(std::max<std::size_t>(rank, 1) - 1);
    std::nth_element(values.begin(), nth, values.end());
    return static_cast<double>(*nth);
}

}  // namespace akimap::app
