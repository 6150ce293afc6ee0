// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <string>

#include "input/clouds/Cloud.h"

namespace akimap::app {

/** Reads the vertices of a .ply file: ascii, or binary of either byte order.
 * \exception std::runtime_error naming the file and the line or byte */
[[nodiscard]] Cloud readPlyCloud(const std::string& file);

/** Throws as readPlyCloud() would for a wrong header or too short data. */
void checkPly(const std::string& file);

}  // namespace akimap::app
