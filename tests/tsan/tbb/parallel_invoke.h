// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

// See parallel_for.h beside this.
#include <tbb/parallel_for.h>

#include <functional>

namespace tbb {

template <class... Functions>
void parallel_invoke(const Functions&... functions) {
    const std::vector<std::function<void()>> all{std::cref(functions)...};
    akimap_tsan::run(all.size(), [&](std::size_t i) { all[i](); });
}

}  // namespace tbb
