// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <akimap/AkiMap.h>

#include <string>

#include "pictures/picture.h"

namespace akimap::app {

/** The clouds and the .bt go by the threshold; `unknown` is for .png and .3Dscene. */
using ExportOptions = PictureOptions;

/** Writes the map as .csv, .ply, .pcd, .bt, .ot, .3Dscene or .png, by the file's extension. The
 * file appears whole or not at all.
 * \exception std::runtime_error naming the file and what is wrong */
void exportMap(const AkiMap& map, const std::string& file, const ExportOptions& options = {});

/** Whether options.unknown makes a difference to files of this extension. */
[[nodiscard]] bool drawsUnknown(const std::string& file);

/** For asking before long work.
 * \exception std::runtime_error if the extension is unknown or the file can't be written */
void checkExportable(const std::string& file);

}  // namespace akimap::app
