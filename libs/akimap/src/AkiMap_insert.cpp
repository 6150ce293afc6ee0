// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <akimap/AkiMap.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>

#include "Scratch.h"
#include "rays.h"

namespace akimap {
namespace {

class Stopwatch {
 public:
    /** Seconds since the last call, or since this was made. */
    double lap() {
        const auto now = std::chrono::steady_clock::now();
        const double s = std::chrono::duration<double>(now - last_).count();
        last_ = now;
        return s;
    }

 private:
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/** TBB warns on stderr when it is asked for more threads than it allows. */
int threadsFor(const InsertionParameters& p) {
    const auto most =
        tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
    return static_cast<int>(p.threads ? std::min<std::size_t>(p.threads, most) : most);
}

/** A kernel must stay within the block keys' margin, and a slip of a unit within the memory. */
void requireReachWithinGrid(const InsertionParameters& p, double resolution) {
    const auto require = [&](const char* name, double reach) {
        if (reach > kMaxKernelCells * resolution)
            throw std::invalid_argument(std::string(name) + " reaches over more than " +
                                        std::to_string(kMaxKernelCells) + " cells of " +
                                        std::to_string(resolution) + " m");
    };
    // A covariance about the sample, over M - 2, exceeds the squared range by at most 3 times.
    require("search_range_max", 2 * p.search_range_max * std::max(1.0, p.scale_max));
    require("search_range_origin", 2 * p.search_range_origin * std::max(1.0, p.scale_max));
    require("covariance_floor", 2 * std::sqrt(p.covariance_floor) * std::max(1.0, p.scale_max));
    require("isotropic_length", p.isotropic_length);
}

}  // namespace

bool AkiMap::insertRays(const std::vector<Ray>& rays) {
    const InsertionParameters& p = insertionOptions;
    p.validate();
    requireReachWithinGrid(p, resolution());
    if (!scratch_) scratch_ = std::make_unique<Scratch>();
    Scratch& s = *scratch_;

    bool changed = false;
    tbb::task_arena arena(threadsFor(p));
    arena.execute([&] {
        Stopwatch watch;
        takeSamples(rays, p, grid_, scan_index_, s.taken, s.samples, stats_);
        stats_.seconds_sampling += watch.lap();
        bandwidths(s.samples, p, resolution(), s.neighbors, s.H);
        stats_.seconds_bandwidth += watch.lap();
        changed = scatter(s.samples, s.H, grid_, s.scatter);
        stats_.seconds_update += watch.lap();
    });
    if (changed) ++scan_index_, ++stats_.scans;
    return changed;
}

bool AkiMap::internal_insertObservation(
    const mrpt::obs::CObservation& obs,
    const std::optional<const mrpt::poses::CPose3D>& robotPose) {
    const mrpt::poses::CPose3D fixed = robotPose ? *robotPose : mrpt::poses::CPose3D();
    const RobotPoseAt at_rest = [&](mrpt::Clock::time_point) { return std::optional(fixed); };
    const auto rays = raysOf(obs, moving_pose_ ? *moving_pose_ : at_rest);
    return rays && insertRays(*rays);
}

bool AkiMap::insertMovingObservation(const mrpt::obs::CObservation& obs,
                                     const RobotPoseAt& robot_pose_at) {
    const RobotPoseAt counting = [&](mrpt::Clock::time_point time) {
        auto pose = robot_pose_at(time);
        stats_.dropped_poses += !pose;
        return pose;
    };
    struct Setting {  // the base's insertObservation() raises the events and heeds the generic
                      // options
        const RobotPoseAt*& pose;
        ~Setting() { pose = nullptr; }
    } setting{moving_pose_};
    moving_pose_ = &counting;
    return insertObservation(obs);
}

}  // namespace akimap
