// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "report/sheet.h"
#include "grid/BlockGrid.h"

#include <cmath>
#include <stdexcept>

#include "pictures/picture.h"
#include "pictures/png.h"
#include "support/AtomicFile.h"

namespace akimap::bench {
namespace {

using mrpt::img::CImage;

constexpr int kColumns = 3, kTitle = 36;  // [pixels] of height
constexpr int kPanelWidth = app::kPictureWidth * 2 / 5, kPanelHeight = app::kPictureHeight * 2 / 5;

app::MapView viewOf(const app::OccupancyLookup& occupancy, const app::Box& box, double resolution) {
    const BlockGrid grid(resolution);
    const double half = resolution / 2;
    app::MapView view{resolution, {}, occupancy};
    auto& [occupied, free, low, high] = view.cells;
    low = grid.cellAt(box.min[0] + half, box.min[1] + half, box.min[2] + half);
    high = grid.cellAt(box.max[0] - half, box.max[1] - half, box.max[2] - half);
    for (int32_t z = low.z; z <= high.z; z++)
        for (int32_t y = low.y; y <= high.y; y++)
            for (int32_t x = low.x; x <= high.x; x++)
                if (const auto p = occupancy(grid.center(x), grid.center(y), grid.center(z)))
                    (*p > 0.5 ? occupied : free).insert({x, y, z});
    return view;
}

}  // namespace

TruthCells::TruthCells(const Scene& scene) : grid_(scene.truth.resolution) {
    scene.truth.forEachCell(scene.box, [&](double x, double y, double z, bool is_occupied) {
        (is_occupied ? occupied_ : free_).insert(grid_.cellAt(x, y, z));
    });
}

app::OccupancyLookup TruthCells::lookup() const {
    return [this](double x, double y, double z) -> std::optional<double> {
        const CellIndex c = grid_.cellAt(x, y, z);
        if (occupied_.contains(c)) return 1;
        if (free_.contains(c)) return 0;
        return std::nullopt;
    };
}

CImage whiteSheet(int width, int height) {
    CImage sheet(width, height, mrpt::img::CH_RGB);
    sheet.filledRectangle(0, 0, width - 1, height - 1, mrpt::img::TColor::white());
    return sheet;
}

void saveWhole(const CImage& sheet, const std::string& file) {
    writeWhole(file, app::pngOf(sheet));
}

void writeSheet(const Scene& scene, const std::vector<NamedMap>& maps, const std::string& file) {
    const double resolution = scene.truth.resolution;
    const TruthCells truth(scene);
    std::vector<NamedMap> panels = {{"the truth", truth.lookup()}};
    panels.insert(panels.end(), maps.begin(), maps.end());
    app::PictureOptions options;
    options.slice = 1.0;
    const auto viewpoint =
        app::chooseViewpoint(viewOf(panels.front().occupancy, scene.box, resolution), options);

    const int rows = (static_cast<int>(panels.size()) + kColumns - 1) / kColumns;
    CImage sheet = whiteSheet(kColumns * kPanelWidth, rows * (kPanelHeight + kTitle));
    for (std::size_t i = 0; i < panels.size(); i++) {
        const int left = static_cast<int>(i % kColumns) * kPanelWidth;
        const int top = static_cast<int>(i / kColumns) * (kPanelHeight + kTitle);
        CImage full =
            app::draw(viewOf(panels[i].occupancy, scene.box, resolution), viewpoint, options);
        CImage panel;
        full.scaleImage(panel, kPanelWidth, kPanelHeight, mrpt::img::IMG_INTERP_AREA);
        sheet.drawImage(left, top + kTitle, panel);
        sheet.selectTextFont("10x20");
        sheet.textOut(left + 16, top + 10, panels[i].name, app::kInk);
    }
    saveWhole(sheet, file);
}

}  // namespace akimap::bench
