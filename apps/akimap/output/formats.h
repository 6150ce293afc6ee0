// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <akimap/AkiMap.h>

#include <string>

#include "output/export_map.h"

namespace akimap::app {

// One writer for each family of formats. Each overwrites `path`, a file of the caller's choice
// that already has the right extension, and throws std::runtime_error saying what went wrong
// without naming the file.

/** One row x,y,z,occupancy,alpha,beta for each cell with evidence, in 9 significant digits:
 * its centre [m], and alpha and beta with the prior. */
void writeCsv(const AkiMap& map, const std::string& path);

/** Binary PLY: the centres [m] of the occupied cells, with occupancy, surfaceNormal() and its
 * confidence (zeros where there is none), and a colour by height. */
void writePly(const AkiMap& map, const std::string& path, const ExportOptions& options);

/** Binary PCD: the centres [m] of the occupied cells, the occupancy as intensity. */
void writePcd(const AkiMap& map, const std::string& path, const ExportOptions& options);

/** OctoMap binary tree: each cell with evidence is occupied or free by the threshold. */
void writeBt(const AkiMap& map, const std::string& path, const ExportOptions& options);

/** OctoMap tree with the log-odds of each cell's occupancy, clamped to kMinOccupancy and its
 * opposite, where a cell that only ever saw one kind of evidence would come near infinity. */
void writeOt(const AkiMap& map, const std::string& path);
inline constexpr double kMinOccupancy = 1e-4;

/** An MRPT scene with the map's own visualization, and translucent where free space borders on
 * the unknown if options.unknown. */
void writeScene(const AkiMap& map, const std::string& path, const ExportOptions& options);

/** A picture: the occupied cells as seen obliquely from above, coloured by height, beside a
 * slice of the occupancy. Throws too if the map is empty or options.slice lies outside it. */
void writePng(const AkiMap& map, const std::string& path, const ExportOptions& options);

}  // namespace akimap::app
