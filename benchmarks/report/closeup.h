// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <string>
#include <vector>

#include "report/sheet.h"

namespace akimap::bench {

/** A part of a scene to look at closely. */
struct Patch {
    std::string what;
    app::Box box;               ///< [m] about two metres a side, with what lies before and behind
    double azimuth, elevation;  ///< [rad] where the camera stands as seen from its centre
};

/** The patches, one a row, in the truth and in each map from the same viewpoint, in one PNG. Each
 * cell's colour tells what the map says of it beside the truth; cells that are free in both, or
 * that the map does not know and that are not occupied, are not drawn. \exception
 * std::runtime_error naming the file */
void writeCloseUps(const Scene& scene, const std::vector<NamedMap>& maps,
                   const std::vector<Patch>& patches, const std::string& file);

}  // namespace akimap::bench
