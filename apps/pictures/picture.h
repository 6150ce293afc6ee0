// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <mrpt/img/CImage.h>

#include <functional>
#include <optional>

#include "pictures/Camera.h"
#include "pictures/MapCells.h"
#include "pictures/voxel_view.h"

namespace akimap::app {

/** What is drawn. */
struct PictureOptions {
    double threshold = 0.5;       ///< [-] in (0,1). Cells with a higher occupancy are occupied
    bool unknown = false;         ///< Draw cells without evidence too
    std::optional<double> slice;  ///< [m] Height of the picture's slice; default: above the floor,
                                  ///< where most is known
};

/** What a picture shows of a map, whatever its class. */
struct MapView {
    double resolution;  ///< [m]
    MapCells cells;
    /** The occupancy at a place [m]; empty without evidence. */
    std::function<std::optional<double>(double, double, double)> occupancy;
};
/** The map must outlive its view. */
[[nodiscard]] MapView viewOf(const AkiMap& map, double threshold);

/** From where and how a map is shown. Pictures that are to be compared share one. */
struct Viewpoint {
    Camera camera;
    HeightRange heights;  ///< of the colours
    double cut;           ///< [cells] occupied cells from this height on are left out
};
/** Such that much of this map is seen. \pre some cell is occupied */
[[nodiscard]] Viewpoint chooseViewpoint(const MapView& map, const PictureOptions& options);

/** \param viewpoint none: nothing is occupied
 * \exception std::runtime_error if options.slice lies outside the map */
[[nodiscard]] mrpt::img::CImage draw(const MapView& map, const std::optional<Viewpoint>& viewpoint,
                                     const PictureOptions& options);

inline constexpr int kPictureWidth = 1600, kPictureHeight = 1000;  // [pixels]
inline constexpr int kPictureMargin = 32;
inline const mrpt::img::TColor kInk(38, 50, 64), kPaleInk(84, 96, 112);

}  // namespace akimap::app
