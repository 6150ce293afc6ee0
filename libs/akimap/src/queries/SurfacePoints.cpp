// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "queries/SurfacePoints.h"

#include <array>
#include <cmath>
#include <mutex>

namespace akimap {
namespace {

/** The blocks around one, itself included. */
class Surroundings {
 public:
    Surroundings(const BlockGrid& grid, const CellIndex& b) {
        std::size_t i = 0;
        for (int z = -1; z <= 1; z++)
            for (int y = -1; y <= 1; y++)
                for (int x = -1; x <= 1; x++)
                    blocks_[i++] = BlockGrid::isAddressable({b.x + x, b.y + y, b.z + z})
                                       ? grid.find({b.x + x, b.y + y, b.z + z})
                                       : nullptr;
    }
    /** The cell's sum of occupied evidence. \param x, y, z  in the middle block, -8 to 15 */
    [[nodiscard]] double alpha(int x, int y, int z) const {
        const Block* block = blockOf(x, y, z);
        const int cell = Block::offset(x & 7, y & 7, z & 7);
        return block ? static_cast<double>(block->alpha[static_cast<std::size_t>(cell)]) : 0;
    }
    /** How far the surface lies from its centre, MapView::surfaceDistance(). */
    [[nodiscard]] std::optional<double> distance(int x, int y, int z) const {
        const Block* block = blockOf(x, y, z);
        if (!block) return std::nullopt;
        return MapView::surfaceDistanceIn(*block, Block::offset(x & 7, y & 7, z & 7));
    }

 private:
    [[nodiscard]] const Block* blockOf(int x, int y, int z) const {
        const int at = (((z >> 3) + 1) * 3 + (y >> 3) + 1) * 3 + (x >> 3) + 1;
        return blocks_[static_cast<std::size_t>(at)];
    }
    std::array<const Block*, 27> blocks_{};
};

/** From the cell's centre to the centroid of the occupied evidence in 3 x 3 x 3 cells [cells]. */
std::array<double, 3> evidenceCentroid(const Surroundings& s, int x, int y, int z) {
    std::array<double, 3> sum{};
    double weights = 0;
    for (int dz = -1; dz <= 1; dz++)
        for (int dy = -1; dy <= 1; dy++)
            for (int dx = -1; dx <= 1; dx++) {
                const double w = s.alpha(x + dx, y + dy, z + dz);
                sum[0] += dx * w, sum[1] += dy * w, sum[2] += dz * w;
                weights += w;
            }
    const double share = 1 / weights;
    return {sum[0] * share, sum[1] * share, sum[2] * share};
}

/** From the cell's centre to the surface at a distance from it, along the distance's gradient
 * [cells]; empty where that is not known, or no plane's. */
std::optional<std::array<double, 3>> alongGradient(const Surroundings& s, int x, int y, int z,
                                                   double distance) {
    constexpr double kLeast = 0.5;  // of the gradient's length, which is 1 before a plane
    std::array<double, 3> gradient{};
    for (int axis = 0; axis < 3; axis++) {
        const int dx = axis == 0, dy = axis == 1, dz = axis == 2;
        const auto before = s.distance(x - dx, y - dy, z - dz),
                   after = s.distance(x + dx, y + dy, z + dz);
        if (!before && !after) return std::nullopt;
        const double steps = before && after ? 2 : 1;
        gradient[static_cast<std::size_t>(axis)] =
            (after.value_or(distance) - before.value_or(distance)) / steps;
    }
    const double square =
        gradient[0] * gradient[0] + gradient[1] * gradient[1] + gradient[2] * gradient[2];
    if (square < kLeast * kLeast) return std::nullopt;
    for (double& g : gradient) g *= -distance / square;
    return gradient;
}

/** From the centre of an occupied cell to the surface [cells]; empty if it does not pass through
 * the cell. */
std::optional<std::array<double, 3>> toSurface(const Surroundings& s, int x, int y, int z) {
    const auto distance = s.distance(x, y, z);
    if (!distance) return evidenceCentroid(s, x, y, z);
    if (std::abs(*distance) > kOnSurface) return std::nullopt;
    if (const auto to = alongGradient(s, x, y, z, *distance)) return to;
    return std::array<double, 3>{};
}

/** With more evidence for than against, and some for: where the prior alone speaks for occupied
 * there is no surface, and no centroid. */
bool isOccupied(const Block& block, std::size_t i, const Prior& prior) {
    return block.alpha[i] + prior.alpha > block.beta[i] + prior.beta && block.alpha[i] > 0;
}

}  // namespace

template <int kDimensions>
struct SurfacePoints::Tree {
    explicit Tree(const SurfacePoints& points)
        : coordinates{{&points.x_, &points.y_, &points.z_}}, tree(coordinates) {}
    Coordinates coordinates;
    KdTree<kDimensions> tree;
};

struct SurfacePoints::Trees {
    std::once_flag once2, once3;
    std::unique_ptr<const Tree<2>> tree2;
    std::unique_ptr<const Tree<3>> tree3;
};

SurfacePoints::SurfacePoints(const MapView& map) : trees_(std::make_unique<Trees>()) {
    const BlockGrid& grid = map.grid;
    for (const auto& [b, block] : grid.sortedBlocks()) {
        std::optional<Surroundings> around;
        for (int i = 0; i < Block::kCells; i++) {
            if (!isOccupied(*block, static_cast<std::size_t>(i), map.prior)) continue;
            if (!around) around.emplace(grid, b);
            const int x = i & 7, y = i >> 3 & 7, z = i >> 6;
            const auto d = toSurface(*around, x, y, z);
            if (!d) continue;
            const double r = grid.resolution();
            x_.push_back(static_cast<float>(grid.center(b.x * 8 + x) + (*d)[0] * r));
            y_.push_back(static_cast<float>(grid.center(b.y * 8 + y) + (*d)[1] * r));
            z_.push_back(static_cast<float>(grid.center(b.z * 8 + z) + (*d)[2] * r));
        }
    }
}

SurfacePoints::~SurfacePoints() = default;

const SurfacePoints::Tree<2>& SurfacePoints::tree2() const {
    std::call_once(trees_->once2, [&] { trees_->tree2 = std::make_unique<Tree<2>>(*this); });
    return *trees_->tree2;
}
const SurfacePoints::Tree<3>& SurfacePoints::tree3() const {
    std::call_once(trees_->once3, [&] { trees_->tree3 = std::make_unique<Tree<3>>(*this); });
    return *trees_->tree3;
}
void SurfacePoints::prepare2D() const {
    static_cast<void>(tree2());
}
void SurfacePoints::prepare3D() const {
    static_cast<void>(tree3());
}

std::optional<Neighbor> SurfacePoints::nearest(const Point3& p) const {
    return tree3().tree.nearest(p.data());
}
std::optional<Neighbor> SurfacePoints::nearest(const Point2& p) const {
    return tree2().tree.nearest(p.data());
}
std::vector<Neighbor> SurfacePoints::nearest(const Point3& p, std::size_t count,
                                             float max_sqr_distance) const {
    return tree3().tree.nearest(p.data(), count, max_sqr_distance);
}
std::vector<Neighbor> SurfacePoints::nearest(const Point2& p, std::size_t count,
                                             float max_sqr_distance) const {
    return tree2().tree.nearest(p.data(), count, max_sqr_distance);
}

}  // namespace akimap
