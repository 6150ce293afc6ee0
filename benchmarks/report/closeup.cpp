// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "report/closeup.h"
#include "grid/BlockGrid.h"

#include <array>
#include <cmath>

#include "pictures/Camera.h"
#include "pictures/faces.h"
#include "pictures/picture.h"

namespace akimap::bench {
namespace {

using app::Color;
using mrpt::img::CImage;
using mrpt::img::TColor;

constexpr int kPanelWidth = 470, kPanelHeight = 400;        // [pixels]
constexpr int kRowTitle = 44, kCaption = 62, kLegend = 48;  // [pixels] of height
constexpr int kOversampling = 3;

enum State : std::size_t { right, missed, unknown, wrong, unseen, kStates };
struct Look {
    const char* name;
    Color color;
};
constexpr std::array<Look, kStates> kLooks = {{{"occupied, rightly", {.36f, .53f, .72f}},
                                               {"said to be free", {.98f, .82f, .36f}},
                                               {"not known", {.84f, .86f, .88f}},
                                               {"occupied, but free in truth", {.86f, .30f, .22f}},
                                               {"occupied, truth unknown", {.63f, .53f, .74f}}}};

/** A map's cells in a patch by state. */
struct PatchCells {
    std::array<app::CellSet, kStates> sets;
    app::CellSet drawn;  ///< all of them
};

std::optional<State> stateOf(const std::optional<double>& truth, const std::optional<double>& p) {
    if (truth && *truth > 0.5) return !p ? unknown : *p > 0.5 ? right : missed;
    if (!p || *p <= 0.5) return std::nullopt;
    return truth ? wrong : unseen;
}

struct CellBounds {
    CellIndex low, high;  // both included
};

CellBounds boundsOf(const app::Box& box, const BlockGrid& grid) {
    const double half = grid.resolution() / 2;
    return {grid.cellAt(box.min[0] + half, box.min[1] + half, box.min[2] + half),
            grid.cellAt(box.max[0] - half, box.max[1] - half, box.max[2] - half)};
}

PatchCells cellsIn(const app::Box& box, const BlockGrid& grid, const app::OccupancyLookup& truth,
                   const app::OccupancyLookup& map) {
    PatchCells cells;
    const auto [low, high] = boundsOf(box, grid);
    for (int32_t z = low.z; z <= high.z; z++)
        for (int32_t y = low.y; y <= high.y; y++)
            for (int32_t x = low.x; x <= high.x; x++) {
                const double cx = grid.center(x), cy = grid.center(y), cz = grid.center(z);
                const auto state = stateOf(truth(cx, cy, cz), map(cx, cy, cz));
                if (!state) continue;
                cells.sets[*state].insert({x, y, z});
                cells.drawn.insert({x, y, z});
            }
    return cells;
}

app::Camera cameraFor(const Patch& patch, const BlockGrid& grid) {
    const auto [low, high] = boundsOf(patch.box, grid);
    const app::Point a{double(low.x), double(low.y), double(low.z)},
        b{high.x + 1.0, high.y + 1.0, high.z + 1.0};
    std::vector<app::Point> corners;
    for (int i = 0; i < 8; i++)
        corners.push_back({i & 1 ? b[0] : a[0], i & 2 ? b[1] : a[1], i & 4 ? b[2] : a[2]});
    const double radius = std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]) / 2;
    app::Camera camera({(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2}, radius,
                       patch.azimuth, patch.elevation);
    constexpr double kMargin = 14;
    camera.fit(corners,
               {kOversampling * kMargin, kOversampling * kMargin,
                kOversampling * (kPanelWidth - kMargin), kOversampling * (kPanelHeight - kMargin)});
    return camera;
}

TColor toTColor(const Color& c) {
    return {static_cast<uint8_t>(255 * c.r), static_cast<uint8_t>(255 * c.g),
            static_cast<uint8_t>(255 * c.b)};
}

CImage drawPatch(const PatchCells& cells, const app::Camera& camera) {
    constexpr float kLight[3][2] = {{.86f, .92f}, {.78f, .88f}, {.60f, 1.f}};
    constexpr float kOpenness[4] = {.70f, .84f, .93f, 1.f};
    constexpr float kRim = 0.16f;
    app::Raster raster(kPanelWidth * kOversampling, kPanelHeight * kOversampling);
    app::forEachExposedFace(cells.drawn, [&](const app::Face& face) {
        const double ahead = camera.eye()[face.axis] - face.corners[0][face.axis];
        if ((ahead > 0) != (face.side == 1)) return;
        std::size_t state = 0;
        while (!cells.sets[state].contains(face.cell)) state++;
        const std::array<int, 4> open = app::openness(cells.drawn, face);
        std::array<app::Raster::Vertex, 4> corners;
        for (std::size_t i = 0; i < 4; i++) {
            corners[i] = camera.project(app::toPoint(face.corners[i]));
            corners[i].brightness = kLight[face.axis][face.side] * kOpenness[open[i]];
        }
        raster.fill(corners, kLooks[state].color, kRim);
    });
    CImage large(raster.width(), raster.height(), mrpt::img::CH_RGB), panel;
    for (int y = 0; y < raster.height(); y++)
        for (int x = 0; x < raster.width(); x++)
            large.setPixel(x, y,
                           raster.isEmpty(x, y) ? TColor::white() : toTColor(raster.color(x, y)));
    large.scaleImage(panel, kPanelWidth, kPanelHeight, mrpt::img::IMG_INTERP_AREA);
    return panel;
}

std::string figuresOf(const PatchCells& cells) {
    const auto count = [&](State s) { return static_cast<double>(cells.sets[s].size()); };
    const double surface = count(right) + count(missed) + count(unknown);
    const auto share = [&](State s) {
        return std::to_string(std::lround(100 * count(s) / surface)) + " %";
    };
    return share(right) + " of the surface found, " + std::to_string(cells.sets[wrong].size()) +
           " cells too many";
}

void drawLegend(CImage& sheet, int top) {
    int x = 16;
    sheet.selectTextFont("9x15");
    for (const Look& look : kLooks) {
        sheet.filledRectangle(x, top, x + 18, top + 18, toTColor(look.color));
        sheet.textOut(x + 26, top + 2, look.name, app::kInk);
        x += 26 + 9 * static_cast<int>(std::char_traits<char>::length(look.name)) + 36;
    }
}

}  // namespace

void writeCloseUps(const Scene& scene, const std::vector<NamedMap>& maps,
                   const std::vector<Patch>& patches, const std::string& file) {
    const BlockGrid grid(scene.truth.resolution);
    const TruthCells truth(scene);
    std::vector<NamedMap> panels = {{"the truth", truth.lookup()}};
    panels.insert(panels.end(), maps.begin(), maps.end());
    constexpr int kRow = kRowTitle + kCaption + kPanelHeight;
    const int height = static_cast<int>(patches.size()) * kRow;
    CImage sheet = whiteSheet(static_cast<int>(panels.size()) * kPanelWidth, height + kLegend);
    for (std::size_t row = 0; row < patches.size(); row++) {
        const app::Camera camera = cameraFor(patches[row], grid);
        const int top = static_cast<int>(row) * kRow;
        sheet.selectTextFont("10x20");
        sheet.textOut(16, top + 16, patches[row].what, app::kPaleInk);
        for (std::size_t i = 0; i < panels.size(); i++) {
            const PatchCells cells =
                cellsIn(patches[row].box, grid, panels.front().occupancy, panels[i].occupancy);
            const int left = static_cast<int>(i) * kPanelWidth;
            CImage panel = drawPatch(cells, camera);
            sheet.drawImage(left, top + kRowTitle + kCaption, panel);
            sheet.selectTextFont("10x20");
            sheet.textOut(left + 16, top + kRowTitle + 8, panels[i].name, app::kInk);
            if (i == 0) continue;
            sheet.selectTextFont("9x15");
            sheet.textOut(left + 16, top + kRowTitle + 34, figuresOf(cells), app::kPaleInk);
        }
    }
    drawLegend(sheet, height + 14);
    saveWhole(sheet, file);
}

}  // namespace akimap::bench
