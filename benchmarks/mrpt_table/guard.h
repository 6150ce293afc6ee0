// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <functional>
#include <string>

namespace akimap::bench {

/** What the work returns, from a process of its own, which may do its worst: "throws: ...",
 * "crashes: ..." with the signal's name, "no answer within 1 s" of processor time, or "hangs" if it
 * waits for a minute. What it prints is dropped. \pre this process has no threads yet */
[[nodiscard]] std::string guarded(const std::function<std::string()>& work);

}  // namespace akimap::bench
