// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <akimap/Ray.h>

#include <string>
#include <vector>

namespace akimap::app {

/** Reads a point cloud (.pcd; ascii, binary or binary_compressed) as one scan: its points [m] are
 * in the map frame and all rays start at the translation of VIEWPOINT. Points that are not finite
 * stay in, in the file's order.
 * \exception std::runtime_error naming the file and the line or byte */
[[nodiscard]] std::vector<Ray> readPcd(const std::string& file);

/** Throws as readPcd() would for a wrong header or too short data, without reading the data. */
void checkPcd(const std::string& file);

}  // namespace akimap::app
