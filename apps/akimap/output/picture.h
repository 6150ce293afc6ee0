// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <akimap/AkiMap.h>

#include "output/export_map.h"

namespace akimap::app {

inline constexpr int kPictureWidth = 1600, kPictureHeight = 1000;  // [pixels]

/** Draws the occupied cells as seen obliquely from above, coloured by height, beside a slice of
 * the occupancy (white free, black occupied, grey-blue unknown), and writes it as a PNG file.
 * \exception std::runtime_error if the map is empty, options.slice lies outside its bounds, or
 * the file can't be written */
void drawPicture(const AkiMap& map, const std::string& file, const ExportOptions& options);

}  // namespace akimap::app
