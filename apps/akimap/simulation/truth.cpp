// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "simulation/truth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <future>
#include <limits>
#include <stdexcept>
#include <string>
#include <thread>

namespace akimap::app {

using mrpt::math::TPoint3D;
using mrpt::math::TVector3D;

namespace {

enum CellFlag : uint8_t { kUnseen = 0, kCrossed = 1, kCut = 2 };

/** The cells around the room, each seen empty, cut by a surface, or not seen at all. */
class SeenCells {
   public:
    SeenCells(const TPoint3D& low, const TPoint3D& high, double resolution)
        : resolution_(resolution) {
        for (std::size_t i = 0; i < 3; i++) {
            first_[i] = static_cast<int>(std::floor(low[i] / resolution));
            count_[i] = static_cast<int>(std::floor(high[i] / resolution)) - first_[i] + 1;
        }
        flags_.resize(static_cast<std::size_t>(count_[0] * count_[1] * count_[2]));
    }

    void markCut(const TPoint3D& p) {
        Index cell;
        for (std::size_t i = 0; i < 3; i++) cell[i] = axisCell(p[i], i);
        mark(cell, kCut);
    }

    /** Marks the cells that a sight line crosses, both ends included (Amanatides and Woo). */
    void markCrossed(const TPoint3D& from, const TVector3D& direction, double length) {
        Index cell{}, step{};
        std::array<double, 3> next{}, period{};
        for (std::size_t i = 0; i < 3; i++) {
            cell[i] = axisCell(from[i], i);
            step[i] = direction[i] < 0 ? -1 : 1;
            const double face = (first_[i] + cell[i] + (step[i] > 0 ? 1 : 0)) * resolution_;
            const bool level = direction[i] == 0;
            constexpr double kNever = std::numeric_limits<double>::infinity();
            next[i] = level ? kNever : (face - from[i]) / direction[i];
            period[i] = level ? kNever : resolution_ / std::abs(direction[i]);
        }
        while (true) {
            mark(cell, kCrossed);
            const std::size_t axis = next[0] < next[1] ? (next[0] < next[2] ? 0 : 2)
                                                       : (next[1] < next[2] ? 1 : 2);
            if (next[axis] > length) return;
            cell[axis] += step[axis];
            next[axis] += period[axis];
        }
    }

    void merge(const SeenCells& other) {
        for (std::size_t i = 0; i < flags_.size(); i++) flags_[i] |= other.flags_[i];
    }

    [[nodiscard]] std::unique_ptr<octomap::OcTree> toTree() const {
        auto tree = std::make_unique<octomap::OcTree>(resolution_);
        std::size_t at = 0;
        for (int z = 0; z < count_[2]; z++)
            for (int y = 0; y < count_[1]; y++)
                for (int x = 0; x < count_[0]; x++, at++) {
                    if (flags_[at] == kUnseen) continue;
                    const bool cut = flags_[at] & kCut;
                    tree->setNodeValue(centre(x, 0), centre(y, 1), centre(z, 2),
                                       cut ? tree->getClampingThresMaxLog()
                                           : tree->getClampingThresMinLog(),
                                       true);
                }
        tree->updateInnerOccupancy();
        return tree;
    }

   private:
    using Index = std::array<int, 3>;

    [[nodiscard]] int axisCell(double v, std::size_t axis) const {
        return static_cast<int>(std::floor(v / resolution_)) - first_[axis];
    }
    [[nodiscard]] double centre(int cell, std::size_t axis) const {
        return (first_[axis] + cell + 0.5) * resolution_;
    }
    void mark(const Index& c, CellFlag flag) {
        for (std::size_t i = 0; i < 3; i++)
            if (c[i] < 0 || c[i] >= count_[i]) return;
        flags_[static_cast<std::size_t>((c[2] * count_[1] + c[1]) * count_[0] + c[0])] |= flag;
    }

    double resolution_;
    Index first_{}, count_{};
    std::vector<uint8_t> flags_;
};

/** Marks the cells cut by the surface points that the view sees. Points of the surface, not
 * hits of rays: rays evenly apart miss cells where they graze a surface. */
void markSurfaces(const Scene& scene, const View& view, const std::vector<SurfacePoint>& surface,
                  SeenCells& cells) {
    constexpr double kTouch = 1e-6;  // [m] what the ray may fall short of its own surface point
    const TPoint3D origin = view.sensor.translation();
    const auto rotation = view.sensor.getRotationMatrix();
    const auto axis = [&](int i) {
        return TVector3D(rotation(0, i), rotation(1, i), rotation(2, i));
    };
    const TVector3D forward = axis(0), left = axis(1), up = axis(2);
    for (const SurfacePoint& point : surface) {
        const TVector3D sight = point.position - origin;
        if (dot(sight, point.normal) >= 0) continue;
        const double distance = sight.norm();
        if (distance < view.min_range || distance > view.max_range) continue;
        if (!view.field.contains({dot(sight, forward), dot(sight, left), dot(sight, up)})) continue;
        const auto hit = scene.castRay(origin, sight / distance);
        if (hit && *hit >= distance - kTouch) cells.markCut(point.position);
    }
}

void markSightLines(const Scene& scene, const View& view, double spacing, SeenCells& cells) {
    const TPoint3D origin = view.sensor.translation();
    view.field.forEachDirection(spacing, [&](const TVector3D& local) {
        const TVector3D direction = view.sensor.rotateVector(local);
        const auto hit = scene.castRay(origin, direction, view.max_range);
        if (!hit || *hit < view.min_range) return;
        cells.markCrossed(origin, direction, *hit);
        cells.markCut(origin + direction * *hit);
    });
}

}  // namespace

std::unique_ptr<octomap::OcTree> visibleTruth(const Scene& scene, const std::vector<View>& views,
                                              double resolution) {
    if (!(resolution >= 0.01 && resolution <= 1))
        throw std::runtime_error("truth resolution: " + std::to_string(resolution) +
                                 " m, but it must be from 0.01 to 1");
    const auto box = scoringBox();
    const SeenCells unseen(box.min, box.max, resolution);

    std::vector<SurfacePoint> surface;
    for (const ShapePtr& shape : scene.shapes()) {
        const auto points = shape->surface(resolution / 4);
        surface.insert(surface.end(), points.begin(), points.end());
    }
    // Flags only ever get set, so the order of the views and threads does not matter.
    const auto look = [&](std::size_t worker, std::size_t workers) {
        SeenCells cells = unseen;
        for (std::size_t i = worker; i < views.size(); i += workers) {
            markSurfaces(scene, views[i], surface, cells);
            markSightLines(scene, views[i], resolution / 3 / views[i].max_range, cells);
        }
        return cells;
    };
    const std::size_t workers = std::max(1u, std::thread::hardware_concurrency());
    std::vector<std::future<SeenCells>> parts;
    for (std::size_t w = 0; w < workers; w++)
        parts.push_back(std::async(std::launch::async, look, w, workers));
    SeenCells all = unseen;
    for (auto& part : parts) all.merge(part.get());
    return all.toTree();
}

TruthCounts countCells(const octomap::OcTree& tree) {
    TruthCounts counts;
    for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf) {
        // A pruned leaf stands for 8 cells a level.
        const std::size_t cells = std::size_t(1) << 3 * (tree.getTreeDepth() - leaf.getDepth());
        (tree.isNodeOccupied(*leaf) ? counts.occupied : counts.free) += cells;
    }
    return counts;
}

}  // namespace akimap::app
