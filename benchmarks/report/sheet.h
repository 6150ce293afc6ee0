// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <string>
#include <vector>

#include "evaluation/evaluate.h"
#include "scenes.h"

namespace akimap::bench {

struct NamedMap {
    std::string name;
    app::OccupancyLookup occupancy;
};

/** All maps of a scene in one PNG, after its truth, from one viewpoint, as in the paper's Fig. 5:
 * the occupied cells by height, and the occupancy 1 m above the ground.
 * \exception std::runtime_error naming the file */
void writeSheet(const Scene& scene, const std::vector<NamedMap>& maps, const std::string& file);

}  // namespace akimap::bench
