// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <functional>
#include <string>

namespace akimap::bench {

/** What the work returns, from a process of its own, which may do its worst: "throws: ...",
 * "crashes: ..." with the signal's name, or "hangs" if it takes longer than 30 s. What it prints
 * is dropped. \pre this process has no threads yet */
[[nodiscard]] std::string guarded(const std::function<std::string()>& work);

}  // namespace akimap::bench
