// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "queries/SurfacePoints.h"

#include <array>
#include <limits>
#include <mutex>

#include "numeric/kd_tree.h"

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
        const int at = (((z >> 3) + 1) * 3 + (y >> 3) + 1) * 3 + (x >> 3) + 1;
        const Block* block = blocks_[static_cast<std::size_t>(at)];
        const int cell = Block::offset(x & 7, y & 7, z & 7);
        return block ? static_cast<double>(block->alpha[static_cast<std::size_t>(cell)]) : 0;
    }

 private:
    std::array<const Block*, 27> blocks_{};
};

/** From the cell's centre to the centroid of the occupied evidence in 3 x 3 x 3 cells [cells]. */
mrpt::math::TPoint3D evidenceCentroid(const Surroundings& s, int x, int y, int z) {
    mrpt::math::TPoint3D sum(0, 0, 0);
    double weights = 0;
    for (int dz = -1; dz <= 1; dz++)
        for (int dy = -1; dy <= 1; dy++)
            for (int dx = -1; dx <= 1; dx++) {
                const double w = s.alpha(x + dx, y + dy, z + dz);
                sum += mrpt::math::TPoint3D(dx, dy, dz) * w;
                weights += w;
            }
    return sum * (1 / weights);
}

bool isOccupied(const Block& block, std::size_t i, const Prior& prior) {
    return block.alpha[i] + prior.alpha > block.beta[i] + prior.beta &&
           block.hasEvidence(static_cast<int>(i));
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

SurfacePoints::SurfacePoints(const BlockGrid& grid, const Prior& prior)
    : trees_(std::make_unique<Trees>()) {
    for (const auto& [b, block] : grid.sortedBlocks()) {
        std::optional<Surroundings> around;
        for (int i = 0; i < Block::kCells; i++) {
            if (!isOccupied(*block, static_cast<std::size_t>(i), prior)) continue;
            if (!around) around.emplace(grid, b);
            const int x = i & 7, y = i >> 3 & 7, z = i >> 6;
            const auto d = evidenceCentroid(*around, x, y, z) * grid.resolution();
            x_.push_back(static_cast<float>(grid.center(b.x * 8 + x) + d.x));
            y_.push_back(static_cast<float>(grid.center(b.y * 8 + y) + d.y));
            z_.push_back(static_cast<float>(grid.center(b.z * 8 + z) + d.z));
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

std::optional<SurfacePoints::Neighbor> SurfacePoints::nearest(const Point3& p) const {
    const float query[] = {p.x, p.y, p.z};
    return tree3().tree.nearest(query);
}
std::optional<SurfacePoints::Neighbor> SurfacePoints::nearest(const Point2& p) const {
    const float query[] = {p.x, p.y};
    return tree2().tree.nearest(query);
}
std::vector<SurfacePoints::Neighbor> SurfacePoints::nearest(const Point3& p, std::size_t count,
                                                            float max_sqr_distance) const {
    const float query[] = {p.x, p.y, p.z};
    return tree3().tree.nearest(query, count, max_sqr_distance);
}
std::vector<SurfacePoints::Neighbor> SurfacePoints::nearest(const Point2& p, std::size_t count,
                                                            float max_sqr_distance) const {
    const float query[] = {p.x, p.y};
    return tree2().tree.nearest(query, count, max_sqr_distance);
}

}  // namespace akimap
