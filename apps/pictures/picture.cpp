// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "pictures/picture.h"
#include "grid/BlockGrid.h"

#include <cmath>
#include <iomanip>
#include <sstream>
#include <stdexcept>

#include "pictures/SliceInset.h"
#include "pictures/faces.h"

namespace akimap::app {

namespace {

using mrpt::img::CImage;
using mrpt::img::TColor;

constexpr int kOversampling = 3;  // pixels drawn for each pixel of the file, on both axes
constexpr Color kVeil{.55f, .60f, .66f};

std::string grouped(std::size_t number) {  // 1234567 -> 1 234 567
    std::string text = std::to_string(number);
    for (std::size_t i = text.size(); i > 3;) text.insert(i -= 3, " ");
    return text;
}

std::string shown(double value, int decimals) {
    std::ostringstream text;
    text << std::fixed << std::setprecision(decimals) << value;
    return text.str();
}

Color background(double y) {
    return mix({.985f, .988f, .992f}, {.865f, .890f, .915f}, static_cast<float>(y));
}

Color colorAt(const Raster& solid, const Raster* veil, int x, int y) {
    const Color behind =
        solid.isEmpty(x, y) ? background(double(y) / solid.height()) : solid.color(x, y);
    if (!veil || veil->nearness(x, y) <= solid.nearness(x, y)) return behind;
    return mix(behind, veil->color(x, y), 0.5f);
}

/** Averages the drawn pixels down to the file's. */
CImage reduce(const Raster& solid, const Raster* veil) {
    CImage image(kPictureWidth, kPictureHeight, mrpt::img::CH_RGB);
    constexpr float kShare = 255.f / (kOversampling * kOversampling);
    for (int y = 0; y < kPictureHeight; y++)
        for (int x = 0; x < kPictureWidth; x++) {
            float r = .5f, g = .5f, b = .5f;
            for (int j = 0; j < kOversampling; j++)
                for (int i = 0; i < kOversampling; i++) {
                    const Color c =
                        colorAt(solid, veil, x * kOversampling + i, y * kOversampling + j);
                    r += c.r * kShare, g += c.g * kShare, b += c.b * kShare;
                }
            image.setPixel(x, y, TColor(uint8_t(r), uint8_t(g), uint8_t(b)));
        }
    return image;
}

/** How many occupied cells look through free ones to -x, +x, -y and +y. */
std::array<double, 4> facing(const MapCells& cells) {
    std::array<double, 4> count{};
    cells.occupied.forEach([&](const CellIndex& c) {
        for (std::size_t i = 0; i < 4; i++)
            count[i] += cells.free.contains(beyond(c, i / 2, static_cast<int>(i % 2)));
    });
    return count;
}

Frame scaled(const Frame& f, double by) {
    return {f.left * by, f.top * by, f.right * by, f.bottom * by};
}

/** Draws where free space ends in the unknown; the bounds themselves would only be in the way. */
void drawVeil(const MapCells& cells, const Camera& camera, Raster& raster) {
    constexpr float kLight[3] = {.82f, .90f, 1.f};
    forEachExposedFace(unknownCells(cells), [&](const Face& face) {
        if (!cells.free.contains(beyond(face.cell, face.axis, face.side))) return;
        const double ahead = camera.eye()[face.axis] - face.corners[0][face.axis];
        if ((ahead > 0) != (face.side == 1)) return;
        std::array<Raster::Vertex, 4> corners;
        for (std::size_t i = 0; i < 4; i++) {
            corners[i] = camera.project(toPoint(face.corners[i]));
            corners[i].brightness = kLight[face.axis];
        }
        raster.fill(corners, kVeil, 0);
    });
}

CImage drawVoxels(const MapCells& cells, const Viewpoint& viewpoint, bool unknown) {
    Raster solid(kPictureWidth * kOversampling, kPictureHeight * kOversampling);
    drawCells(below(cells.occupied, viewpoint.cut), viewpoint.camera, viewpoint.heights, solid);
    if (!unknown) return reduce(solid, nullptr);
    Raster veil(solid.width(), solid.height());
    drawVeil(cells, viewpoint.camera, veil);
    return reduce(solid, &veil);
}

void drawColorBar(CImage& image, int top, double low, double high) {
    constexpr int kWidth = 300, kHeight = 14;
    for (int x = 0; x < kWidth; x++) {
        const Color c = heightColor((x + .5) / kWidth) * 255;
        image.line(kPictureMargin + x, top, kPictureMargin + x, top + kHeight,
                   TColor(uint8_t(c.r), uint8_t(c.g), uint8_t(c.b)));
    }
    const int decimals = high - low < 10 ? 2 : 1;
    image.selectTextFont("9x15");
    for (int i = 0; i < 3; i++) {
        const std::string label = shown(low + i * (high - low) / 2, decimals) + " m";
        const int x = kPictureMargin + i * (kWidth - 9 * static_cast<int>(label.size())) / 2;
        image.textOut(x, top + kHeight + 6, label, kPaleInk);
    }
}

void drawCaption(CImage& image, const MapCells& cells, double resolution, double threshold,
                 double cut) {
    std::ostringstream title, detail;
    title << grouped(cells.occupied.size()) << " occupied cells of " << resolution * 100 << " cm";
    detail << "p > " << threshold << "; " << grouped(cells.occupied.size() + cells.free.size())
           << " cells with evidence";
    image.selectTextFont("10x20");
    image.textOut(kPictureMargin, 26, title.str(), kInk);
    image.selectTextFont("9x15");
    image.textOut(kPictureMargin, 52, detail.str(), kPaleInk);
    if (std::isfinite(cut))
        image.textOut(kPictureMargin, 136,
                      "ceiling above " + shown(cut * resolution, 2) + " m left out", kPaleInk);
}

}  // namespace

MapView viewOf(const AkiMap& map, double threshold) {
    return {map.resolution(), cellsOf(map, threshold),
            [&map](double x, double y, double z) { return map.occupancy(x, y, z); }};
}

Viewpoint chooseViewpoint(const MapView& map, const PictureOptions& options) {
    const double cut = ceiling(map.cells.occupied, map.resolution);
    const CellSet open = below(map.cells.occupied, cut);
    const Frame caption{0, 0, 480, 160}, slice = SliceInset(map, options.slice).frame();
    const Frame all{kPictureMargin, kPictureMargin, kPictureWidth - kPictureMargin,
                    kPictureHeight - kPictureMargin};
    return {chooseCamera(open, scaled(all, kOversampling),
                         {scaled(caption, kOversampling), scaled(slice, kOversampling)},
                         facing(map.cells)),
            heightRange(open), cut};
}

CImage draw(const MapView& map, const std::optional<Viewpoint>& viewpoint,
            const PictureOptions& options) {
    const SliceInset slice(map, options.slice);
    const Raster nothing(kPictureWidth * kOversampling, kPictureHeight * kOversampling);
    CImage image =
        viewpoint ? drawVoxels(map.cells, *viewpoint, options.unknown) : reduce(nothing, nullptr);
    const HeightRange heights = viewpoint ? viewpoint->heights : HeightRange{};
    drawCaption(image, map.cells, map.resolution, options.threshold,
                viewpoint ? viewpoint->cut : kNoCeiling);
    drawColorBar(image, 88, heights.low * map.resolution, heights.high * map.resolution);
    slice.draw(image);
    return image;
}

}  // namespace akimap::app
