// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <array>

#include "pictures/CellSet.h"

namespace akimap::app {

/** A face of a cell that borders on a place outside its set. */
struct Face {
    CellIndex cell;
    std::size_t axis;  ///< of its normal: 0, 1, 2
    int side;          ///< the normal points to the axis' lower (0) or upper (1) end
    /** Round the face, in units of cells: cell i spans [i, i + 1]. */
    std::array<std::array<int32_t, 3>, 4> corners;
};

/** \return the face of the cell towards that side; whether it is exposed is not looked at. */
[[nodiscard]] Face faceOf(const CellIndex& cell, std::size_t axis, int side);

/** The cell on the other side of the face. */
[[nodiscard]] CellIndex beyond(const CellIndex& cell, std::size_t axis, int side);

/** How open the space before each corner of a face is: 3 unless neighbouring cells of the set
 * rise beside it, down to 0 in a nook. Darkening by it makes shapes legible. */
[[nodiscard]] std::array<int, 4> openness(const CellSet& cells, const Face& face);

/** Calls visit(Face) for each face of a cell of the set beyond which the set has none. */
template <class Visitor>
void forEachExposedFace(const CellSet& cells, Visitor&& visit) {
    cells.forEach([&](const CellIndex& cell) {
        for (std::size_t axis = 0; axis < 3; axis++)
            for (int side = 0; side < 2; side++)
                if (!cells.contains(beyond(cell, axis, side))) visit(faceOf(cell, axis, side));
    });
}

}  // namespace akimap::app
