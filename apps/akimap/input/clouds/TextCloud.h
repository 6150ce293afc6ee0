// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <string>

#include "input/clouds/Cloud.h"

namespace akimap::app {

/** Reads lines of x y z, and maybe more, parted by blanks, commas or semicolons. Names in a first
 * line say which column is which; without it they are x y z, and a fourth is the intensity. Blank
 * lines, and those that begin with # or //, are skipped.
 * \exception std::runtime_error naming the file and the line */
[[nodiscard]] Cloud readTextCloud(const std::string& file);

}  // namespace akimap::app
