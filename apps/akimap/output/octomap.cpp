// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <octomap/OcTree.h>

#include <algorithm>
#include <functional>
#include <sstream>

#include "evaluation/octomap_file.h"
#include "output/binary_tree.h"
#include "output/formats.h"
#include "pictures/CellSet.h"
#include "support/stream.h"

namespace akimap::app {

namespace {

octomap::OcTreeKey keyOf(const Cell& cell) {
    const CellIndex c = indexOf(cell);
    for (const int32_t i : {c.x, c.y, c.z})
        if (i < -kOctoMapHalf || i >= kOctoMapHalf) {
            std::ostringstream why;
            why << "an OctoMap tree of " << cell.size << " m cells ends at +-"
                << kOctoMapHalf * cell.size << " m, and the map has a cell at " << cell.x << ", "
                << cell.y << ", " << cell.z;
            throw std::runtime_error(why.str());
        }
    const auto key = [](int32_t i) { return static_cast<octomap::key_type>(i + kOctoMapHalf); };
    return {key(c.x), key(c.y), key(c.z)};
}

/** A tree whose leaves hold the log-odds of the value given for each cell. */
void fillTree(octomap::OcTree& tree, const AkiMap& map,
              const std::function<double(double)>& valueOf) {
    tree.setClampingThresMin(kMinOccupancy);
    tree.setClampingThresMax(1 - kMinOccupancy);
    constexpr bool kInnerNodesLater = true;
    map.forEachCell([&](const Cell& cell) {
        const double value = valueOf(cell.state.occupancy());
        tree.setNodeValue(keyOf(cell), octomap::logodds(value), kInnerNodesLater);
    });
    tree.updateInnerOccupancy();
    tree.prune();
}

}  // namespace

void writeBt(const AkiMap& map, const std::string& path, const ExportOptions& options) {
    octomap::OcTree tree(map.resolution());
    fillTree(tree, map, [&](double occupancy) {
        return occupancy > options.threshold ? 1 - kMinOccupancy : kMinOccupancy;
    });
    std::ofstream out = openForWriting(path);
    writeBinaryTree(tree, out);
    closeWritten(out);
}

void writeOt(const AkiMap& map, const std::string& path) {
    octomap::OcTree tree(map.resolution());
    fillTree(tree, map, [](double occupancy) {
        return std::clamp(occupancy, kMinOccupancy, 1 - kMinOccupancy);
    });
    std::ofstream out = openForWriting(path);
    out.precision(12);
    tree.write(out);
    closeWritten(out);
}

}  // namespace akimap::app
