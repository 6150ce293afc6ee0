// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <akimap/AkiMap.h>

#include <memory>
#include <mutex>
#include <string>

#include "estimators/estimators.h"
#include "queries/SurfaceCache.h"

namespace akimap {

/** What an AkiMap is made of. */
struct AkiMapImpl {
    explicit AkiMapImpl(double resolution) : grid(resolution) {}
    /** Takes over the state; what can be made again from it is left out. */
    AkiMapImpl(const AkiMapImpl& o) : grid(o.grid), next_scan(o.next_scan), stats(o.stats) {}
    AkiMapImpl& operator=(const AkiMapImpl&) = delete;
    /** Replaces the state and keeps the workspace. */
    void setState(BlockGrid&& cells, uint64_t scan, const InsertionStats& counted) {
        const std::lock_guard lock(changing);
        newest_snapshot.reset();
        grid = std::move(cells), next_scan = scan, stats = counted;
        surface.drop();
    }

    BlockGrid grid;
    uint64_t next_scan = 0;  ///< the number of the next scan: with the seed, the whole random state
    InsertionStats stats;

    SurfaceCache surface;                      ///< of the cells; dropped with each change
    std::unique_ptr<ScanEstimator> estimator;  ///< of the last insertion, for its workspace
    Estimator estimator_name{};                ///< which it is
    std::mutex changing;                       ///< held while the cells change or are copied
    std::shared_ptr<const AkiMap> newest_snapshot;
    std::string snapshot_options;              ///< with which it was made
    const RobotPoseAt* moving_pose = nullptr;  ///< set during insertMovingObservation()
};

[[nodiscard]] inline MapView viewOf(const AkiMap& map) {
    return {map.grid(), map.insertionOptions.prior()};
}

}  // namespace akimap
