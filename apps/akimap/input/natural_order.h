// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <string>

namespace akimap::app {

/** scan_2 before scan_10: runs of digits are compared as numbers. A strict order of all texts. */
[[nodiscard]] bool naturallyBefore(const std::string& a, const std::string& b);

/** The name of a file up to its first dot that does not part digits: "1305.16" of
 * "x/1305.16.depth.png". */
[[nodiscard]] std::string frameName(const std::string& file);

/** The last run of digits in a text, maybe with a decimal point in it; empty if there is none. */
[[nodiscard]] std::string lastNumber(const std::string& text);

}  // namespace akimap::app
