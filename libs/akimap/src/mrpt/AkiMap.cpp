// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <akimap/AkiMap.h>
#include <mrpt/config/CConfigFileBase.h>

#include <algorithm>
#include <limits>
#include <sstream>

#include "mrpt/Impl.h"

namespace akimap {

AkiMap::AkiMap(double resolution) : impl_(std::make_unique<AkiMapImpl>(resolution)) {}
AkiMap::~AkiMap() = default;

AkiMap::AkiMap(const AkiMap& o)
    : insertionOptions(o.insertionOptions),
      likelihoodOptions(o.likelihoodOptions),
      renderingOptions(o.renderingOptions),
      impl_(std::make_unique<AkiMapImpl>(*o.impl_)) {
    genericMapParams = o.genericMapParams;  // not by the base's copy: that takes its observers too
}

AkiMap& AkiMap::operator=(const AkiMap& o) {
    if (this == &o) return *this;
    BlockGrid grid = o.impl_->grid;  // may run out of memory: before anything changes
    genericMapParams = o.genericMapParams;
    insertionOptions = o.insertionOptions;
    likelihoodOptions = o.likelihoodOptions;
    renderingOptions = o.renderingOptions;
    impl_->setState(std::move(grid), o.impl_->next_scan, o.impl_->stats);
    return *this;
}

std::shared_ptr<const AkiMap> AkiMap::snapshot() const {
    const std::lock_guard lock(impl_->changing);
    std::string options =
        insertionOptions.toText() + likelihoodOptions.toText() + renderingOptions.toText();
    for (const bool option :
         {genericMapParams.enableSaveAs3DObject, genericMapParams.enableObservationLikelihood,
          genericMapParams.enableObservationInsertion})
        options += option ? '1' : '0';
    if (!impl_->newest_snapshot || impl_->snapshot_options != options) {
        impl_->newest_snapshot = AkiMap::Create(*this);
        impl_->snapshot_options = options;
    }
    return impl_->newest_snapshot;
}

void AkiMap::internal_clear() {
    setResolution(resolution());
}

void AkiMap::auxParticleFilterCleanUp() {
    impl_->surface.drop();
    impl_->estimator.reset();
}

void AkiMap::setResolution(double resolution) {
    impl_->setState(BlockGrid(resolution), 0, {});
}

double AkiMap::resolution() const {
    return impl_->grid.resolution();
}
const BlockGrid& AkiMap::grid() const {
    return impl_->grid;
}
const InsertionStats& AkiMap::stats() const {
    return impl_->stats;
}
bool AkiMap::isEmpty() const {
    return impl_->grid.isEmpty();
}
std::size_t AkiMap::cellCount() const {
    return impl_->grid.countCells();
}
std::size_t AkiMap::blockCount() const {
    return impl_->grid.blockCount();
}
std::size_t AkiMap::memoryBytes() const {
    return impl_->grid.memoryBytes();
}

void AkiMap::visitCells(const std::function<void(const Cell*, std::size_t)>& visit) const {
    constexpr std::size_t kAtOnce = 256;
    std::vector<Cell> cells;
    cells.reserve(kAtOnce);
    const auto flush = [&] {
        visit(cells.data(), cells.size());
        cells.clear();
    };
    akimap::forEachCell(viewOf(*this), [&](const Cell& c) {
        cells.push_back(c);
        if (cells.size() == kAtOnce) flush();
    });
    flush();
}

std::optional<CellState> AkiMap::cell(double x, double y, double z) const {
    return viewOf(*this).cell(x, y, z);
}

std::optional<double> AkiMap::occupancy(double x, double y, double z) const {
    const auto state = cell(x, y, z);
    return state ? std::optional(state->occupancy()) : std::nullopt;
}

std::vector<mrpt::math::TPoint3Df> AkiMap::occupiedCells(double threshold) const {
    std::vector<mrpt::math::TPoint3Df> centers;
    forEachCell([&](const Cell& c) {
        if (c.state.occupancy() > threshold)
            centers.emplace_back(static_cast<float>(c.x), static_cast<float>(c.y),
                                 static_cast<float>(c.z));
    });
    return centers;
}

mrpt::math::TBoundingBoxf AkiMap::boundingBox() const {
    if (isEmpty()) return {};
    constexpr double kMost = std::numeric_limits<double>::max();
    mrpt::math::TPoint3D low(kMost, kMost, kMost), high(-kMost, -kMost, -kMost);
    forEachCell([&](const Cell& c) {
        const double half = c.size / 2, center[3] = {c.x, c.y, c.z};
        for (std::size_t i = 0; i < 3; i++) {
            low[i] = std::min(low[i], center[i] - half);
            high[i] = std::max(high[i], center[i] + half);
        }
    });
    return {low.cast<float>(), high.cast<float>()};
}

std::string AkiMap::asString() const {
    std::ostringstream text;
    text << "akimap::AkiMap, resolution=" << resolution() << " m, cells=" << cellCount()
         << ", memory=" << memoryBytes() << " bytes";
    return text.str();
}

}  // namespace akimap
