// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <akimap/queries.h>

#include <optional>
#include <vector>

#include "output/formats.h"
#include "pictures/MapCells.h"
#include "pictures/colors.h"
#include "pictures/voxel_view.h"
#include "support/stream.h"

namespace akimap::app {

namespace {

struct OccupiedCell {
    mrpt::math::TPoint3Df center;  // [m]
    float occupancy;
};

std::vector<OccupiedCell> occupiedCells(const AkiMap& map, double threshold) {
    std::vector<OccupiedCell> cells;
    map.forEachCell([&](const Cell& cell) {
        if (const double p = cell.state.occupancy(); p > threshold)
            cells.push_back({mrpt::math::TPoint3D(cell.x, cell.y, cell.z).cast<float>(),
                             static_cast<float>(p)});
    });
    return cells;
}

std::string toBytes(const OccupiedCell& cell) {
    std::string bytes;
    for (const float v : {cell.center.x, cell.center.y, cell.center.z, cell.occupancy})
        appendBytes(bytes, v);
    return bytes;
}

/** Zeros where there is none. */
std::string toBytes(const std::optional<SurfaceNormal>& normal) {
    const SurfaceNormal n = normal.value_or(SurfaceNormal{{0, 0, 0}, 0});
    std::string bytes;
    for (const double v : {n.direction.x, n.direction.y, n.direction.z, n.confidence})
        appendBytes(bytes, static_cast<float>(v));
    return bytes;
}

}  // namespace

void writePly(const AkiMap& map, const std::string& path, const ExportOptions& options) {
    const auto cells = occupiedCells(map, options.threshold);
    const HeightRange heights = heightRange(cellsOf(map, options.threshold).occupied);
    std::ofstream out = openForWriting(path);
    out << "ply\nformat binary_little_endian 1.0\n"
        << "comment centres of the occupied cells of an akimap of " << map.resolution() << " m\n"
        << "element vertex " << cells.size() << "\n"
        << "property float x\nproperty float y\nproperty float z\nproperty float occupancy\n"
        << "property float nx\nproperty float ny\nproperty float nz\nproperty float confidence\n"
        << "property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n";
    for (const OccupiedCell& cell : cells) {
        const Color c = heightColor(heights.place(cell.center.z / map.resolution())) * 255.f;
        std::string bytes = toBytes(cell) + toBytes(surfaceNormal(map, cell.center.x, cell.center.y,
                                                                  cell.center.z));
        for (const float v : {c.r, c.g, c.b}) appendBytes(bytes, static_cast<uint8_t>(v + 0.5f));
        out << bytes;
    }
    closeWritten(out);
}

void writePcd(const AkiMap& map, const std::string& path, const ExportOptions& options) {
    const auto cells = occupiedCells(map, options.threshold);
    std::ofstream out = openForWriting(path);
    out << "# .PCD v0.7 - centres of the occupied cells of an akimap; intensity: occupancy\n"
        << "VERSION 0.7\nFIELDS x y z intensity\nSIZE 4 4 4 4\nTYPE F F F F\nCOUNT 1 1 1 1\n"
        << "WIDTH " << cells.size() << "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\n"
        << "POINTS " << cells.size() << "\nDATA binary\n";
    for (const OccupiedCell& cell : cells) out << toBytes(cell);
    closeWritten(out);
}

}  // namespace akimap::app
