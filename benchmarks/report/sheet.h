// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <mrpt/img/CImage.h>

#include <string>
#include <vector>

#include "evaluation/evaluate.h"
#include "pictures/CellSet.h"
#include "scenes.h"

namespace akimap::bench {

struct NamedMap {
    std::string name;
    app::OccupancyLookup occupancy;
};

/** A scene's truth as if it were a map. */
class TruthCells {
 public:
    explicit TruthCells(const Scene& scene);
    /** Reads from this object, which must outlive what is returned. */
    [[nodiscard]] app::OccupancyLookup lookup() const;

 private:
    BlockGrid grid_;
    app::CellSet occupied_, free_;
};

/** All maps of a scene in one PNG, after its truth, from one viewpoint, as in the paper's Fig. 5:
 * the occupied cells by height, and the occupancy 1 m above the ground.
 * \exception std::runtime_error naming the file */
void writeSheet(const Scene& scene, const std::vector<NamedMap>& maps, const std::string& file);

/** Of that size [pixels]. */
[[nodiscard]] mrpt::img::CImage whiteSheet(int width, int height);
/** As a PNG. \exception std::runtime_error naming the file */
void saveWhole(const mrpt::img::CImage& sheet, const std::string& file);

}  // namespace akimap::bench
