// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace akimap::app {

/** The q-quantile by nearest rank: the least of the values that at least the share q of them does
 * not exceed. O(n). Takes its argument by value because it sorts partly.
 * \pre there is a value, and q is in [0, 1] */
template <class T>
[[nodiscard]] T quantile(std::vector<T> values, double q) {
    const auto rank = static_cast<std::size_t>(std::ceil(q * static_cast<double>(values.size())));
    const auto nth =
        values.begin() + static_cast<std::ptrdiff_t>(std::max<std::size_t>(rank, 1) - 1);
    std::nth_element(values.begin(), nth, values.end());
    return *nth;
}

}  // namespace akimap::app
