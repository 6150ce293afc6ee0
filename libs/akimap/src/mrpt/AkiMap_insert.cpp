// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "mrpt/Impl.h"

namespace akimap {

bool AkiMap::insertRays(const std::vector<Ray>& rays) {
    AkiMapImpl& map = *impl_;
    const std::lock_guard lock(map.changing);
    map.newest_snapshot.reset();  // blocks that nobody else has need not be copied
    if (!map.estimator || map.estimator_name != insertionOptions.estimator) {
        insertionOptions.validate();
        map.estimator = makeEstimator(insertionOptions.estimator);
        map.estimator_name = insertionOptions.estimator;
    }
    const uint64_t used = map.stats.points + map.stats.free_beams;
    const bool changed =
        insertScan(*map.estimator, {rays, map.next_scan}, insertionOptions, map.grid, map.stats);
    // Scans with a usable ray are numbered, whatever became of them in these cells: a part of a map
    // must draw what the whole draws.
    map.next_scan += map.stats.points + map.stats.free_beams > used;
    if (changed) map.surface.drop();
    return changed;
}

InsertionParameters AkiMap::optionsInForce() const {
    insertionOptions.validate();
    return makeEstimator(insertionOptions.estimator)->inForce(insertionOptions, resolution());
}

bool AkiMap::internal_insertObservation(
    const mrpt::obs::CObservation& obs,
    const std::optional<const mrpt::poses::CPose3D>& robotPose) {
    const mrpt::poses::CPose3D fixed = robotPose ? *robotPose : mrpt::poses::CPose3D();
    const RobotPoseAt at_rest = [&](mrpt::Clock::time_point) { return std::optional(fixed); };
    const bool with_free = insertionOptions.beyond_max_range == BeyondMaxRange::free;
    const auto rays = impl_->moving_pose ? raysOf(obs, *impl_->moving_pose, true, with_free)
                                         : raysOf(obs, at_rest, false, with_free);
    return rays && insertRays(*rays);
}

bool AkiMap::insertMovingObservation(const mrpt::obs::CObservation& obs,
                                     const RobotPoseAt& robot_pose_at) {
    const RobotPoseAt counting = [&](mrpt::Clock::time_point time) {
        auto pose = robot_pose_at(time);
        impl_->stats.dropped_poses += !pose;
        return pose;
    };
    struct Setting {  // the base's insertObservation() raises the events and heeds the generic
                      // options
        const RobotPoseAt*& pose;
        ~Setting() { pose = nullptr; }
    } setting{impl_->moving_pose};
    impl_->moving_pose = &counting;
    return insertObservation(obs);
}

}  // namespace akimap
