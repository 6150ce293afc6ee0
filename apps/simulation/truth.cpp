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

enum CellFlag : uint8_t {
    kCrossed = 1,  ///< by a sight line
    kCut = 2,      ///< by a surface, though perhaps by a part that no view sees
    kSeenCut = 4   ///< by a surface that some view sees
};

/** The cells of the scoring box: each crossed by a sight line, cut by a surface, or not seen. */
class SeenCells {
 public:
    explicit SeenCells(double resolution) : resolution_(resolution) {
        const auto box = scoringBox();
        for (std::size_t i = 0; i < 3; i++) {
            first_[i] = static_cast<int>(std::floor(box.min[i] / resolution));
            count_[i] = static_cast<int>(std::floor(box.max[i] / resolution)) - first_[i] + 1;
        }
        stride_ = {1, count_[0], count_[0] * count_[1]};
        flags_.resize(static_cast<std::size_t>(stride_[2] * count_[2]));
    }

    void mark(const TPoint3D& p, CellFlag flag) {
        int at = 0;
        for (std::size_t i = 0; i < 3; i++) {
            const int cell = axisCell(p[i], i);
            if (cell < 0 || cell >= count_[i]) return;
            at += cell * stride_[i];
        }
        flags_[static_cast<std::size_t>(at)] |= flag;
    }

    /** Marks the cells that a sight line crosses between two distances from its origin, both
     * ends included (Amanatides and Woo). \pre both ends are in the scoring box */
    void markCrossed(const TPoint3D& origin, const TVector3D& direction, double from, double to) {
        constexpr double kNever = std::numeric_limits<double>::infinity();
        Index step{};
        std::array<double, 3> next{}, period{};
        int at = 0;
        for (std::size_t i = 0; i < 3; i++) {
            const int cell = axisCell(origin[i] + from * direction[i], i);
            const double face = (first_[i] + cell + (direction[i] > 0 ? 1 : 0)) * resolution_;
            at += cell * stride_[i];
            step[i] = direction[i] < 0 ? -stride_[i] : stride_[i];
            next[i] = direction[i] == 0 ? kNever : (face - origin[i]) / direction[i];
            period[i] = resolution_ / std::abs(direction[i]);
        }
        while (true) {
            flags_[static_cast<std::size_t>(at)] |= kCrossed;
            const std::size_t axis =
                next[0] < next[1] ? (next[0] < next[2] ? 0 : 2) : (next[1] < next[2] ? 1 : 2);
            if (next[axis] > to) return;
            at += step[axis];
            next[axis] += period[axis];
        }
    }

    void merge(const SeenCells& other) {
        for (std::size_t i = 0; i < flags_.size(); i++) flags_[i] |= other.flags_[i];
    }

    [[nodiscard]] std::unique_ptr<octomap::OcTree> toTree() const {
        auto tree = std::make_unique<octomap::OcTree>(resolution_);
        const float occupied = tree->getClampingThresMaxLog();
        const float free = tree->getClampingThresMinLog();
        for (std::size_t at = 0; at < flags_.size(); at++) {
            if (flags_[at] & kSeenCut)
                tree->setNodeValue(centre(at, 0), centre(at, 1), centre(at, 2), occupied, true);
            else if (flags_[at] == kCrossed)
                tree->setNodeValue(centre(at, 0), centre(at, 1), centre(at, 2), free, true);
        }
        tree->updateInnerOccupancy();
        return tree;
    }

 private:
    using Index = std::array<int, 3>;

    [[nodiscard]] int axisCell(double v, std::size_t axis) const {
        return static_cast<int>(std::floor(v / resolution_)) - first_[axis];
    }
    [[nodiscard]] double centre(std::size_t at, std::size_t axis) const {
        const int cell = static_cast<int>(at) / stride_[axis] % count_[axis];
        return (first_[axis] + cell + 0.5) * resolution_;
    }

    double resolution_;
    Index first_{}, count_{}, stride_{};
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
        if (!view.field.contains({dot(sight, forward), dot(sight, left), dot(sight, up)})) continue;
        const double distance = sight.norm();
        if (distance < view.min_range || distance > view.max_range) continue;
        const auto hit = scene.castRay(origin, sight / distance);
        if (hit && *hit >= distance - kTouch) cells.mark(point.position, kSeenCut);
    }
}

/** \param apart  of the lines where they end [m] */
void markSightLines(const Scene& scene, const View& view, double apart, SeenCells& cells) {
    const TPoint3D origin = view.sensor.translation();
    constexpr double kFarthest = 13;  // [m] more than the room's diagonal
    const double farthest = std::min(view.max_range, kFarthest);
    view.field.forEachDirection(apart / farthest, [&](const TVector3D& local, int doublings) {
        // Close to the sensor lines crowd: there the coarser grid that leaves this line out, of
        // twice the spacing, is as dense as need be.
        const double start = std::ldexp(farthest, -1 - doublings);
        const TVector3D direction = view.sensor.rotateVector(local);
        const auto hit = scene.castRay(origin, direction, farthest);
        if (!hit || *hit < view.min_range) return;
        cells.mark(origin + direction * *hit, kSeenCut);
        if (*hit > start) cells.markCrossed(origin, direction, start, *hit);
    });
}

}  // namespace

std::unique_ptr<octomap::OcTree> visibleTruth(const Scene& scene, const std::vector<View>& views,
                                              double resolution) {
    if (!(resolution >= 0.01 && resolution <= 1))
        throw std::runtime_error("truth resolution: " + std::to_string(resolution) +
                                 " m, but it must be from 0.01 to 1");
    SeenCells all(resolution);
    std::vector<SurfacePoint> surface;
    for (const ShapePtr& shape : scene.shapes()) {
        const auto points = shape->surface(resolution / 4);
        surface.insert(surface.end(), points.begin(), points.end());
    }
    for (const SurfacePoint& point : surface) all.mark(point.position, kCut);
    // Flags only ever get set, so the order of the views and threads does not matter.
    const auto look = [&](std::size_t worker, std::size_t workers) {
        SeenCells cells(resolution);
        for (std::size_t i = worker; i < views.size(); i += workers) {
            markSurfaces(scene, views[i], surface, cells);
            markSightLines(scene, views[i], resolution / 3, cells);
        }
        return cells;
    };
    const std::size_t workers = std::max(1u, std::thread::hardware_concurrency());
    std::vector<std::future<SeenCells>> parts;
    for (std::size_t w = 0; w < workers; w++)
        parts.push_back(std::async(std::launch::async, look, w, workers));
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
