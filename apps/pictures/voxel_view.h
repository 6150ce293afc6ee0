// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <limits>
#include <vector>

#include "pictures/Camera.h"
#include "pictures/CellSet.h"
#include "pictures/Raster.h"

namespace akimap::app {

/** The heights between which colours run, in cells. */
struct HeightRange {
    double low = 0, high = 1;
    [[nodiscard]] double place(double z) const { return (z - low) / (high - low); }
};
/** From the lowest to the highest cells of the set, but for one in a hundred at each end, which
 * are as likely outliers. */
[[nodiscard]] HeightRange heightRange(const CellSet& cells);

/** The height [cells] from which on cells would hide the rooms from above; kNoCeiling if none do.
 */
[[nodiscard]] double ceiling(const CellSet& cells, double resolution);
inline constexpr double kNoCeiling = std::numeric_limits<double>::infinity();
[[nodiscard]] CellSet below(const CellSet& cells, double height);

/** Where to look from and how large, so that the picture is full and shows much.
 * \param taken parts of the picture to keep clear, all at its left
 * \param facing how many surfaces of interest look to -x, +x, -y, +y */
[[nodiscard]] Camera chooseCamera(const CellSet& cells, const Frame& picture,
                                  const std::vector<Frame>& taken,
                                  const std::array<double, 4>& facing);

/** Draws the cells' exposed faces that look to the camera, coloured by height. */
void drawCells(const CellSet& cells, const Camera& camera, const HeightRange& heights,
               Raster& raster);

}  // namespace akimap::app
