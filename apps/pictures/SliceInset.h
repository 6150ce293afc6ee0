// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <mrpt/img/CImage.h>

#include <optional>

#include "grid/BlockGrid.h"
#include "pictures/picture.h"

namespace akimap::app {

/** The occupancy of the cells of one height, at the lower left of the picture: white is free,
 * black occupied, grey-blue unknown; x to the right, y upwards. */
class SliceInset {
 public:
    /** \param height [m]; by default above the floor, where most is known. The map has some cell
     * and outlives this.
     * \exception std::runtime_error if the height lies outside the map's bounds */
    SliceInset(const MapView& map, std::optional<double> height);

    /** The part of the picture that it takes. */
    [[nodiscard]] Frame frame() const;
    void draw(mrpt::img::CImage& image) const;

 private:
    void drawCells(mrpt::img::CImage& image) const;
    void drawLegend(mrpt::img::CImage& image) const;
    void drawScaleBar(mrpt::img::CImage& image) const;

    const MapView& map_;
    CellIndex lowest_, highest_;
    double height_;  // [m]
    double scale_;   // pixels a cell
    int left_, top_, width_, height_pixels_;
};

}  // namespace akimap::app
