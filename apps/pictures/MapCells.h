// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <akimap/AkiMap.h>

#include "pictures/CellSet.h"

namespace akimap::app {

/** A map's cells by kind. */
struct MapCells {
    CellSet occupied, free;
    CellIndex lowest, highest;  ///< the bounds of all cells with evidence, both included
};

/** \param threshold cells with a higher occupancy are occupied */
[[nodiscard]] MapCells cellsOf(const AkiMap& map, double threshold);

/** The cells within the bounds that the map has no evidence for.
 * \exception std::runtime_error if the bounds hold more than kMaxUnknown cells */
[[nodiscard]] CellSet unknownCells(const MapCells& cells);
inline constexpr double kMaxUnknown = 5e7;

}  // namespace akimap::app
