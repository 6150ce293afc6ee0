// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "evaluation/contest/faithfulness.h"

namespace akimap::app {

Faithfulness faithfulness(const OccupancyCells& map, const ReturnCounts& returns) {
    Faithfulness sum;
    OccupancyCells::Reader reader(map);
    const auto is_occupied = [&](const CellIndex& c) { return isOccupied(reader[c]); };
    returns.forEach([&](const CellIndex& c, uint32_t count) {
        if (count < kFaithfulReturns) return;
        sum.cells++;
        sum.occupied += is_occupied(c) ? 1 : 0;
        sum.occupied_nearby += anyWithinOneCell(c, is_occupied) ? 1 : 0;
    });
    return sum;
}

}  // namespace akimap::app
