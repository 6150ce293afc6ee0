// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <Eigen/Core>
#include <optional>

#include "queries/MapView.h"

namespace akimap {

/** See SurfaceNormal in akimap/queries.h. */
struct CellNormal {
    Eigen::Vector3d direction;
    double confidence;
};
[[nodiscard]] std::optional<CellNormal> normalAt(const MapView& map, double x, double y, double z);

}  // namespace akimap
