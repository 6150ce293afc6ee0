// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <string>

namespace akimap::app {

/** What went wrong, on one line: MRPT's what() wraps it in a banner, a place in its sources and a
 * call stack, several times over. Other texts are only joined to one line. */
[[nodiscard]] std::string reasonOf(std::string what);

}  // namespace akimap::app
