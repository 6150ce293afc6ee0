// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <akimap/AkiMap.h>
#include <akimap/rays.h>
#include <tbb/global_control.h>
#include <tbb/parallel_invoke.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "mrpt/Scratch.h"

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

/** A kernel must stay within the block keys' margin, and a slip of a unit within the memory: the
 * farthest that each option lets a kernel reach from its sample. */
void requireReachWithinGrid(const InsertionParameters& p, double resolution) {
    if (resolution > p.max_range)
        throw std::invalid_argument("resolution: a cell must not be larger than max_range");
    const auto require = [&](const char* name, double reach) {
        if (reach <= kMaxKernelCells * resolution) return;
        std::ostringstream text;
        text << name << ": kernels could reach " << reach << " m, more than " << kMaxKernelCells
             << " cells of " << resolution << " m";
        throw std::invalid_argument(text.str());
    };
    if (p.estimator == Estimator::surface)
        return require("surface_range", widestSurfel(p, resolution));
    const double scale = std::max(1.0, p.scale_max);
    // A covariance about the sample, over M - 2 with M = 3, is twice the square of the range on
    // each axis.
    const double range = std::max(p.search_range_max, std::max(p.search_range_origin, resolution));
    require("search_range_max, search_range_origin and scale_max", scale * std::sqrt(2.0) * range);
    require("covariance_floor and scale_max", scale * std::sqrt(covarianceFloor(p, resolution)));
    require("isotropic_length", p.isotropic_length);
}

/** [cells] Wide enough that neighbouring balls leave no hole. */
double freeRadius(const InsertionParameters& p, double resolution) {
    return std::clamp(p.free_radius / resolution, 1.5, double{FreeSpace::kMaxRadius});
}

/** The paper's method: rooms 2 to 4. \return whether the map changed */
bool insertSamples(const std::vector<Ray>& rays, const InsertionParameters& p, uint64_t scan_index,
                   AkiMap::Scratch& s, BlockGrid& grid, InsertionStats& stats) {
    Stopwatch watch;
    takeSamples(rays, p, grid, scan_index, s.taken, s.samples, stats);
    stats.seconds_sampling += watch.lap();
    bandwidths(s.samples, p, grid.resolution(), s.neighbors, s.H);
    stats.seconds_bandwidth += watch.lap();
    const bool changed = scatter(s.samples, s.H, grid, s.scatter);
    stats.seconds_update += watch.lap();
    return changed;
}

/** Surfaces and free space. \return whether the map changed */
bool insertSurfaces(const std::vector<Ray>& rays, const InsertionParameters& p, AkiMap::Scratch& s,
                    BlockGrid& grid, InsertionStats& stats) {
    EvidenceScratch& e = s.evidence;
    const double resolution = grid.resolution(), radius = freeRadius(p, resolution);
    Stopwatch watch;
    const auto kept = takeHits(rays, p, grid, s.taken, s.samples, stats);
    stats.seconds_sampling += watch.lap();
    fitSurfels(kept.hits, s.samples, p, resolution, e.fit, e.surfels, s.H);
    stats.seconds_bandwidth += watch.lap();
    const CellIndex& anchor = s.samples.anchor;
    tbb::parallel_invoke(
        [&] {
            stats.samples_free +=
                markFree(kept.hits, e.surfels, radius, resolution, anchor, e.free_parts, e.free);
            stats.samples_free += markFreeBeams(kept.free, radius, resolution, anchor, e.free);
            e.free.spread(radius);
        },
        [&] { groupKernels(s.samples, s.H, resolution, s.scatter, KernelWeight::one); });
    const bool changed = addEvidence(anchor, s.scatter, e.free, radius, p.max_evidence, grid, e);
    stats.seconds_update += watch.lap();
    return changed;
}

}  // namespace

bool AkiMap::insertRays(const std::vector<Ray>& rays) {
    const InsertionParameters& p = insertionOptions;
    p.validate();
    requireReachWithinGrid(p, resolution());
    if (!scratch_) scratch_ = std::make_unique<Scratch>();
    Scratch& s = *scratch_;

    bool changed = false;
    InsertionStats stats = stats_;  // taken over when nothing can throw any more
    tbb::task_arena arena(threadsFor(p));
    arena.execute([&] {
        changed = p.estimator == Estimator::surface
                      ? insertSurfaces(rays, p, s, grid_, stats)
                      : insertSamples(rays, p, scan_index_, s, grid_, stats);
    });
    stats_ = stats;
    if (changed) ++scan_index_, ++stats_.scans;
    return changed;
}

bool AkiMap::internal_insertObservation(
    const mrpt::obs::CObservation& obs,
    const std::optional<const mrpt::poses::CPose3D>& robotPose) {
    const mrpt::poses::CPose3D fixed = robotPose ? *robotPose : mrpt::poses::CPose3D();
    const RobotPoseAt at_rest = [&](mrpt::Clock::time_point) { return std::optional(fixed); };
    const bool with_free = insertionOptions.beyond_max_range == BeyondMaxRange::free;
    const auto rays = moving_pose_ ? raysOf(obs, *moving_pose_, true, with_free)
                                   : raysOf(obs, at_rest, false, with_free);
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
