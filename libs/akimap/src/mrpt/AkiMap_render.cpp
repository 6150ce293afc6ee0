// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <akimap/AkiMap.h>
#include <mrpt/img/color_maps.h>
#include <mrpt/opengl/COctoMapVoxels.h>
#include <mrpt/opengl/CPointCloudColoured.h>

#include <algorithm>
#include <limits>

namespace akimap {
namespace {

using mrpt::img::TColor;
using mrpt::img::TColorf;
using mrpt::opengl::COctoMapVoxels;
using mrpt::opengl::CPointCloudColoured;

/** A cell as it is drawn. */
struct DrawnCell {
    mrpt::math::TPoint3Df center;
    float size;
    bool occupied;
};

std::vector<DrawnCell> drawnCells(const AkiMap& map) {
    const RenderingParameters& r = map.renderingOptions;
    std::vector<DrawnCell> cells;
    map.forEachCell([&](const Cell& c) {
        const bool occupied = c.state.occupancy() > r.threshold;
        const mrpt::math::TPoint3Df center(static_cast<float>(c.x), static_cast<float>(c.y),
                                           static_cast<float>(c.z));
        if (occupied || r.show_free)
            cells.push_back({center, static_cast<float>(c.size), occupied});
    });
    return cells;
}

/** Colour by height between the lowest and the highest drawn cell. */
class HeightColors {
 public:
    explicit HeightColors(const std::vector<DrawnCell>& cells) {
        for (const auto& c : cells) {
            const float z = c.center.z;  // no reference to it: MRPT packs its points, unaligned
            low_ = std::min(low_, z), high_ = std::max(high_, z);
        }
    }
    [[nodiscard]] TColorf operator()(const DrawnCell& c) const {
        if (!c.occupied) return {0.6f, 0.8f, 0.6f, 0.1f};
        const float t = high_ > low_ ? (c.center.z - low_) / (high_ - low_) : 0;
        TColorf color;
        mrpt::img::jet2rgb(t, color.R, color.G, color.B);
        color.A = 1;
        return color;
    }

 private:
    float low_ = std::numeric_limits<float>::max(), high_ = std::numeric_limits<float>::lowest();
};

mrpt::opengl::CRenderizable::Ptr asVoxels(const std::vector<DrawnCell>& cells,
                                          const mrpt::math::TBoundingBoxf& box) {
    const HeightColors colors(cells);
    auto voxels = COctoMapVoxels::Create();
    voxels->setBoundingBox(box.min, box.max);  // without it the viewer culls the map as a point
    voxels->resizeVoxelSets(2);
    voxels->setVisualizationMode(COctoMapVoxels::FIXED);
    voxels->showGridLines(false);
    for (const auto& c : cells) {
        const TColorf f = colors(c);
        const TColor color(mrpt::f2u8(f.R), mrpt::f2u8(f.G), mrpt::f2u8(f.B), mrpt::f2u8(f.A));
        voxels->push_back_Voxel(
            c.occupied ? mrpt::opengl::VOXEL_SET_OCCUPIED : mrpt::opengl::VOXEL_SET_FREESPACE,
            COctoMapVoxels::TVoxel(c.center, static_cast<double>(c.size), color));
    }
    return voxels;
}

mrpt::opengl::CRenderizable::Ptr asPoints(const std::vector<DrawnCell>& cells) {
    const HeightColors colors(cells);
    auto points = CPointCloudColoured::Create();
    points->setPointSize(3);
    points->reserve(cells.size());
    for (const auto& c : cells) {
        const TColorf f = colors(c);
        points->push_back(c.center.x, c.center.y, c.center.z, f.R, f.G, f.B, f.A);
    }
    return points;
}

}  // namespace

void AkiMap::getVisualizationInto(mrpt::opengl::CSetOfObjects& out) const {
    if (!genericMapParams.enableSaveAs3DObject) return;
    const auto cells = drawnCells(*this);
    if (cells.empty()) return;
    out.insert(cells.size() > renderingOptions.max_voxels ? asPoints(cells)
                                                          : asVoxels(cells, boundingBox()));
}

}  // namespace akimap
