// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "pictures/faces.h"
#include "grid/BlockGrid.h"

namespace akimap::app {

namespace {

constexpr int kTurn[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};  // once round a unit square

CellIndex toCell(const std::array<int32_t, 3>& a) {
    return {a[0], a[1], a[2]};
}

}  // namespace

CellIndex beyond(const CellIndex& cell, std::size_t axis, int side) {
    std::array<int32_t, 3> at{cell.x, cell.y, cell.z};
    at[axis] += side ? 1 : -1;
    return toCell(at);
}

Face faceOf(const CellIndex& cell, std::size_t axis, int side) {
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    Face face{cell, axis, side, {}};
    for (std::size_t i = 0; i < 4; i++) {
        face.corners[i] = {cell.x, cell.y, cell.z};
        face.corners[i][axis] += side;
        face.corners[i][u] += kTurn[i][0];
        face.corners[i][v] += kTurn[i][1];
    }
    return face;
}

std::array<int, 4> openness(const CellSet& cells, const Face& face) {
    const std::size_t u = (face.axis + 1) % 3, v = (face.axis + 2) % 3;
    const CellIndex front = beyond(face.cell, face.axis, face.side);
    std::array<int, 4> open{};
    for (std::size_t i = 0; i < 4; i++) {
        std::array<int32_t, 3> along_u{front.x, front.y, front.z}, along_v = along_u;
        along_u[u] += kTurn[i][0] ? 1 : -1;
        along_v[v] += kTurn[i][1] ? 1 : -1;
        std::array<int32_t, 3> diagonal = along_u;
        diagonal[v] = along_v[v];
        const bool at_u = cells.contains(toCell(along_u)), at_v = cells.contains(toCell(along_v));
        open[i] = at_u && at_v ? 0 : 3 - at_u - at_v - cells.contains(toCell(diagonal));
    }
    return open;
}

}  // namespace akimap::app
