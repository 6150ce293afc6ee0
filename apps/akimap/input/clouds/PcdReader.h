// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <akimap/Ray.h>

#include <optional>
#include <string>
#include <vector>

#include "input/clouds/Cloud.h"

namespace akimap::app {

/** Reads a point cloud (.pcd; ascii, binary or binary_compressed). Points that are not finite stay
 * in, in the file's order.
 * \exception std::runtime_error naming the file and the line or byte */
[[nodiscard]] Cloud readPcdCloud(const std::string& file);

/** The same as one scan in the map frame: all rays start at the translation of VIEWPOINT. */
[[nodiscard]] std::vector<Ray> readPcd(const std::string& file);

/** The VIEWPOINT, if the file has one, without reading the data.
 * \exception std::runtime_error as readPcdCloud(), for a wrong header or too short data */
[[nodiscard]] std::optional<PcdViewpoint> peekPcd(const std::string& file);

}  // namespace akimap::app
