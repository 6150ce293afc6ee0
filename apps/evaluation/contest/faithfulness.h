// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <cstddef>

#include "evaluation/contest/next_scan.h"

namespace akimap::app {

/** Of the cells into which at least kFaithfulReturns returns of a map's own scans fell, how many
 * are occupied. A map that forgets what was measured is sharp for nothing. */
struct Faithfulness {
    std::size_t cells = 0;
    std::size_t occupied = 0;         ///< the cell itself
    std::size_t occupied_nearby = 0;  ///< it, or one of its 26 neighbours

    [[nodiscard]] double share() const { return of(occupied); }  ///< NaN without cells
    [[nodiscard]] double shareNearby() const { return of(occupied_nearby); }
    Faithfulness& operator+=(const Faithfulness& o) {
        cells += o.cells, occupied += o.occupied, occupied_nearby += o.occupied_nearby;
        return *this;
    }

 private:
    [[nodiscard]] double of(std::size_t count) const {
        return static_cast<double>(count) / static_cast<double>(cells);
    }
};
inline constexpr uint32_t kFaithfulReturns = 3;

/** \param returns of the map's own scans, those within the range limits */
[[nodiscard]] Faithfulness faithfulness(const OccupancyCells& map, const ReturnCounts& returns);

}  // namespace akimap::app
