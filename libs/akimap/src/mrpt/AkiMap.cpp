// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <akimap/AkiMap.h>
#include <mrpt/config/CConfigFileBase.h>

#include <algorithm>
#include <limits>
#include <sstream>

#include "mrpt/Scratch.h"

namespace akimap {

AkiMap::AkiMap(double resolution) : grid_(resolution) {}
AkiMap::~AkiMap() = default;

AkiMap::AkiMap(const AkiMap& o)
    : mrpt::maps::CMetricMap(o),
      insertionOptions(o.insertionOptions),
      likelihoodOptions(o.likelihoodOptions),
      renderingOptions(o.renderingOptions),
      grid_(o.grid_),
      scan_index_(o.scan_index_),
      stats_(o.stats_) {}

AkiMap& AkiMap::operator=(const AkiMap& o) {
    if (this == &o) return *this;
    mrpt::maps::CMetricMap::operator=(o);
    insertionOptions = o.insertionOptions;
    likelihoodOptions = o.likelihoodOptions;
    renderingOptions = o.renderingOptions;
    grid_ = o.grid_;
    scan_index_ = o.scan_index_;
    stats_ = o.stats_;
    return *this;
}

void AkiMap::internal_clear() {
    setResolution(resolution());
}

void AkiMap::auxParticleFilterCleanUp() {
    surface_cache_.drop();
    scratch_.reset();
}

void AkiMap::setResolution(double resolution) {
    grid_ = BlockGrid(resolution);
    scan_index_ = 0;
    stats_ = {};
}

std::optional<CellState> AkiMap::cell(double x, double y, double z) const {
    if (!grid_.hasCell(x, y, z)) return std::nullopt;
    const CellIndex c = grid_.cellAt(x, y, z);
    const Block* block = grid_.find(BlockGrid::blockOf(c));
    const int i = BlockGrid::offsetOf(c);
    if (!block || !block->hasEvidence(i)) return std::nullopt;
    const auto at = static_cast<std::size_t>(i);
    return CellState{block->alpha[at] + insertionOptions.prior_alpha,
                     block->beta[at] + insertionOptions.prior_beta};
}

std::optional<double> AkiMap::occupancy(double x, double y, double z) const {
    const auto state = cell(x, y, z);
    return state ? std::optional(state->occupancy()) : std::nullopt;
}

std::vector<mrpt::math::TPoint3Df> AkiMap::occupiedCells(double threshold) const {
    std::vector<mrpt::math::TPoint3Df> centers;
    forEachCell([&](const mrpt::math::TPoint3D& p, const CellState& s) {
        if (s.occupancy() > threshold) centers.emplace_back(p.cast<float>());
    });
    return centers;
}

mrpt::math::TBoundingBoxf AkiMap::boundingBox() const {
    if (isEmpty()) return {};
    constexpr int32_t kMost = std::numeric_limits<int32_t>::max();
    CellIndex low{kMost, kMost, kMost}, high{-kMost, -kMost, -kMost};
    grid_.forEachCell([&](const CellIndex& c, float, float) {
        low = {std::min(low.x, c.x), std::min(low.y, c.y), std::min(low.z, c.z)};
        high = {std::max(high.x, c.x), std::max(high.y, c.y), std::max(high.z, c.z)};
    });
    const auto corner = [&](const CellIndex& c, double up) {
        return mrpt::math::TPoint3D(grid_.center(c.x) + up, grid_.center(c.y) + up,
                                    grid_.center(c.z) + up)
            .cast<float>();
    };
    return {corner(low, -resolution() / 2), corner(high, resolution() / 2)};
}

std::string AkiMap::asString() const {
    std::ostringstream text;
    text << "akimap::AkiMap, resolution=" << resolution() << " m, cells=" << cellCount()
         << ", memory=" << grid_.memoryBytes() << " bytes";
    return text.str();
}

}  // namespace akimap
