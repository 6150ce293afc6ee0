// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "pictures/SliceInset.h"
#include "grid/BlockGrid.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <stdexcept>

#include "pictures/voxel_view.h"

namespace akimap::app {

namespace {

using mrpt::img::TColor;

constexpr int kMaxWidth = 420, kMaxHeight = 400, kBelow = 62;  // [pixels]
constexpr Color kUnknown{.66f, .71f, .78f}, kFree{1, 1, 1}, kOccupied{0, 0, 0};

/** Of the layer with the most evidence, which is about the sensor's height. Those near the floor
 * are left out, if others are left: there many rays end, but floors make poor plans. */
double defaultHeight(const MapCells& cells, double resolution) {
    std::map<int32_t, std::size_t> evidence;  // cells by height
    const auto count = [&](const CellIndex& c) { evidence[c.z]++; };
    cells.occupied.forEach(count);
    cells.free.forEach(count);
    const double floor = cells.occupied.size() ? heightRange(cells.occupied).low : cells.lowest.z;
    auto first = evidence.upper_bound(static_cast<int32_t>(floor + 0.5 / resolution));
    if (first == evidence.end()) first = evidence.begin();
    const auto most = std::max_element(first, evidence.end(),
                                       [](auto& a, auto& b) { return a.second < b.second; });
    return (most->first + 0.5) * resolution;
}

TColor toPixel(const Color& c) {
    const auto byte = [](float v) { return static_cast<uint8_t>(v * 255 + .5f); };
    return TColor(byte(c.r), byte(c.g), byte(c.b));
}

}  // namespace

SliceInset::SliceInset(const MapView& map, std::optional<double> height)
    : map_(map),
      lowest_(map.cells.lowest),
      highest_(map.cells.highest),
      height_(height.value_or(defaultHeight(map.cells, map.resolution))),
      left_(kPictureMargin) {
    const double low = lowest_.z * map.resolution, high = (highest_.z + 1) * map.resolution;
    if (!(height_ >= low && height_ < high)) {
        std::ostringstream why;
        why << "--slice " << height_ << " lies outside the map, whose heights run from " << low
            << " to " << high << " m";
        throw std::runtime_error(why.str());
    }
    const double columns = highest_.x - lowest_.x + 1.0, rows = highest_.y - lowest_.y + 1.0;
    scale_ = std::min({kMaxWidth / columns, kMaxHeight / rows, 20.0});
    width_ = std::max(1, static_cast<int>(columns * scale_));
    height_pixels_ = std::max(1, static_cast<int>(rows * scale_));
    top_ = kPictureHeight - kBelow - height_pixels_;
}

Frame SliceInset::frame() const {
    const double right = left_ + std::max(width_, 330) + 24;
    return {0, double(top_ - 50), right, kPictureHeight};
}

void SliceInset::draw(mrpt::img::CImage& image) const {
    std::ostringstream title;
    title << "occupancy at z = " << std::round(height_ * 1000) / 1000 << " m";
    image.selectTextFont("9x15");
    image.textOut(left_, top_ - 24, title.str(), kInk);
    drawCells(image);
    drawScaleBar(image);
    drawLegend(image);
}

void SliceInset::drawCells(mrpt::img::CImage& image) const {
    constexpr int kSamples = 3;  // a pixel, on both axes
    const double resolution = map_.resolution, step = 1 / (scale_ * kSamples);
    for (int v = 0; v < height_pixels_; v++)
        for (int u = 0; u < width_; u++) {
            Color sum;
            for (int s = 0; s < kSamples * kSamples; s++) {
                const double x = lowest_.x + (u * kSamples + s % kSamples + .5) * step;
                const double y = highest_.y + 1 - (v * kSamples + s / kSamples + .5) * step;
                const auto p = map_.occupancy(x * resolution, y * resolution, height_);
                const Color c = p ? mix(kFree, kOccupied, static_cast<float>(*p)) : kUnknown;
                sum = {sum.r + c.r, sum.g + c.g, sum.b + c.b};
            }
            image.setPixel(left_ + u, top_ + v, toPixel(sum * (1.f / (kSamples * kSamples))));
        }
    image.rectangle(left_ - 1, top_ - 1, left_ + width_, top_ + height_pixels_, kPaleInk);
}

void SliceInset::drawLegend(mrpt::img::CImage& image) const {
    const std::pair<Color, const char*> entries[] = {
        {kFree, "free"}, {kOccupied, "occupied"}, {kUnknown, "unknown"}};
    int x = left_;
    const int y = top_ + height_pixels_ + 34;
    image.selectTextFont("9x15");
    for (const auto& [color, name] : entries) {
        image.filledRectangle(x, y, x + 12, y + 12, toPixel(color));
        image.rectangle(x, y, x + 12, y + 12, kPaleInk);
        image.textOut(x + 20, y - 1, name, kPaleInk);
        x += 20 + 9 * static_cast<int>(std::string(name).size()) + 20;
    }
}

void SliceInset::drawScaleBar(mrpt::img::CImage& image) const {
    const double pixels_per_metre = scale_ / map_.resolution;
    double metres = std::pow(10, std::floor(std::log10(width_ / pixels_per_metre)));
    if (metres * pixels_per_metre > 0.6 * width_)
        metres /= 5;
    else if (metres * pixels_per_metre < 0.2 * width_)
        metres *= 2;
    const int y = top_ + height_pixels_ + 14;
    const int right = left_ + static_cast<int>(metres * pixels_per_metre);
    image.line(left_, y, right, y, kInk, 2);
    std::ostringstream label;
    label << metres << " m";
    image.selectTextFont("9x15");
    image.textOut(right + 10, y - 7, label.str(), kInk);
}

}  // namespace akimap::app
