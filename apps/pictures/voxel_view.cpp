// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "pictures/voxel_view.h"
#include "grid/BlockGrid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "pictures/faces.h"
#include "quantile.h"

namespace akimap::app {

namespace {

std::vector<CellIndex> listOf(const CellSet& cells) {
    std::vector<CellIndex> list;
    list.reserve(cells.size());
    cells.forEach([&](const CellIndex& c) { list.push_back(c); });
    return list;
}

/** The lowest cells of the slabs that hang alone in the air above `floor`, one a column: the
 * topmost cells of a column if they are thin and nothing is right below. */
std::vector<int32_t> overhangs(std::vector<CellIndex> cells, double floor, double thickness,
                               double clearance, std::size_t& columns) {
    std::sort(cells.begin(), cells.end(), [](const CellIndex& a, const CellIndex& b) {
        return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z > b.z;
    });
    std::vector<int32_t> found;
    columns = 0;
    for (std::size_t i = 0; i < cells.size(); columns++) {
        const CellIndex top = cells[i];
        const auto inColumn = [&](std::size_t j) {
            return j < cells.size() && cells[j].x == top.x && cells[j].y == top.y;
        };
        int32_t bottom = top.z;
        while (inColumn(i) && top.z - cells[i].z <= thickness) bottom = cells[i++].z;
        if (bottom > floor && !(inColumn(i) && bottom - cells[i].z < clearance))
            found.push_back(bottom);
        while (inColumn(i)) i++;
    }
    return found;
}

bool overlaps(const Camera& camera, const std::vector<Point>& points,
              const std::vector<Frame>& taken) {
    for (const Point& p : points) {
        const Raster::Vertex v = camera.project(p);
        for (const Frame& f : taken)
            if (v.x > f.left && v.x < f.right && v.y > f.top && v.y < f.bottom) return true;
    }
    return false;
}

/** Two opposite corners of some 10,000 of the cells, without far outliers. */
std::vector<Point> samplePoints(const CellSet& cells) {
    const std::vector<CellIndex> list = listOf(cells);
    std::vector<Point> points;
    const std::size_t step = list.size() / 10000 + 1;
    for (std::size_t i = 0; i < list.size(); i += step) {
        const Point p{double(list[i].x), double(list[i].y), double(list[i].z)};
        points.push_back(p);
        points.push_back({p[0] + 1, p[1] + 1, p[2] + 1});
    }
    for (std::size_t axis = 0; axis < 3; axis++) {
        std::vector<double> values;
        for (const Point& p : points) values.push_back(p[axis]);
        const double low = quantile(values, 0.002), high = quantile(values, 0.998);
        const double slack = (high - low) / 4 + 1;
        points.erase(std::remove_if(points.begin(), points.end(),
                                    [&](const Point& p) {
                                        return p[axis] < low - slack || p[axis] > high + slack;
                                    }),
                     points.end());
    }
    return points;
}

struct Sphere {
    Point center{};
    double radius = 0;
};
Sphere sphereAround(const CellSet& cells) {
    constexpr double kFar = std::numeric_limits<double>::max();
    Point low{kFar, kFar, kFar}, high{-kFar, -kFar, -kFar};
    cells.forEach([&](const CellIndex& c) {
        const Point p{c.x + 0.5, c.y + 0.5, c.z + 0.5};
        for (std::size_t i = 0; i < 3; i++)
            low[i] = std::min(low[i], p[i]), high[i] = std::max(high[i], p[i]);
    });
    Sphere s;
    for (std::size_t i = 0; i < 3; i++) {
        s.center[i] = (low[i] + high[i]) / 2;
        s.radius += (high[i] - low[i]) * (high[i] - low[i]) / 4;
    }
    s.radius = std::sqrt(s.radius) + 1;
    return s;
}

}  // namespace

HeightRange heightRange(const CellSet& cells) {
    std::vector<int32_t> heights;
    heights.reserve(cells.size());
    cells.forEach([&](const CellIndex& c) { heights.push_back(c.z); });
    if (heights.empty()) return {};
    const double low = quantile(heights, 0.01);
    return {low, std::max<double>(quantile(heights, 0.99) + 1, low + 1)};
}

double ceiling(const CellSet& cells, double resolution) {
    const HeightRange heights = heightRange(cells);
    if ((heights.high - heights.low) * resolution < 1.5) return kNoCeiling;
    std::size_t columns = 0;
    std::vector<int32_t> slabs = overhangs(listOf(cells), (heights.low + heights.high) / 2,
                                           0.3 / resolution, 1.0 / resolution, columns);
    const bool hides = static_cast<double>(slabs.size()) >= 0.4 * static_cast<double>(columns);
    return hides && !slabs.empty() ? quantile(slabs, 0.05) : kNoCeiling;
}

CellSet below(const CellSet& cells, double height) {
    CellSet lower;
    cells.forEach([&](const CellIndex& c) {
        if (c.z < height) lower.insert(c);
    });
    return lower;
}

Camera chooseCamera(const CellSet& cells, const Frame& picture, const std::vector<Frame>& taken,
                    const std::array<double, 4>& facing) {
    constexpr double kPi = 3.14159265358979323846, kElevation = 50 * kPi / 180;
    const Sphere sphere = sphereAround(cells);
    const std::vector<Point> points = samplePoints(cells);
    const double sides = facing[0] + facing[1] + facing[2] + facing[3] + 1;
    std::optional<Camera> best;
    double best_score = -1;
    for (int step = 0; step < 12; step++) {
        // Never along an axis: there a room's walls would show only their tops.
        const double azimuth = (step / 3 * 90 + 25 + step % 3 * 20) * kPi / 180;
        const double c = std::cos(azimuth), s = std::sin(azimuth);
        const double seen =
            (c < 0 ? -c * facing[0] : c * facing[1]) + (s < 0 ? -s * facing[2] : s * facing[3]);
        for (int shift = 0; shift <= 8; shift++) {
            Camera camera(sphere.center, sphere.radius, azimuth, kElevation);
            Frame frame = picture;
            frame.left += shift / 8.0 * (picture.right - picture.left) * 0.27;
            camera.fit(points, frame);
            const double score = camera.scale() * (0.2 + seen / sides);
            if (score <= best_score || (shift < 8 && overlaps(camera, points, taken))) continue;
            best_score = score;
            best = camera;
        }
    }
    return *best;
}

void drawCells(const CellSet& cells, const Camera& camera, const HeightRange& heights,
               Raster& raster) {
    // Light from above and from +y; every side a little different, so that edges show.
    constexpr float kLight[3][2] = {{.78f, .86f}, {.70f, .82f}, {.50f, 1.f}};
    constexpr float kOpenness[4] = {.62f, .78f, .90f, 1.f};
    const float rim = camera.scale() > 8 ? 0.12f : 0.f;  // smaller cells would only look dirty
    forEachExposedFace(cells, [&](const Face& face) {
        const double ahead = camera.eye()[face.axis] - face.corners[0][face.axis];
        if ((ahead > 0) != (face.side == 1)) return;
        const std::array<int, 4> open = openness(cells, face);
        std::array<Raster::Vertex, 4> corners;
        for (std::size_t i = 0; i < 4; i++) {
            corners[i] = camera.project(toPoint(face.corners[i]));
            corners[i].brightness = kLight[face.axis][face.side] * kOpenness[open[i]];
        }
        raster.fill(corners, heightColor(heights.place(face.cell.z + 0.5)), rim);
    });
}

}  // namespace akimap::app
