// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "evaluation/contest/next_scan.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "evaluation/contest/beam.h"
#include "quantile.h"

namespace akimap::app {

namespace {

constexpr double kBehind = 4;                 // [cells] that a ray is cast beyond its return
constexpr double kNear1 = 1.5, kNear3 = 3.5;  // [cells]
constexpr float kNotStopped = std::numeric_limits<float>::quiet_NaN();

/** With its own memory of the blocks read last: one for each thread. */
class Caster {
 public:
    Caster(const OccupancyCells& map, const ReturnCounts& returns)
        : cells_(map), map_(map), returns_(returns) {}

    [[nodiscard]] RayOutcome cast(const Ray& ray) {
        const double h = cells_.resolution();
        const Beam beam(ray);
        double depth = std::numeric_limits<double>::quiet_NaN();
        CellIndex stop;
        walkCells(beam, beam.length + kBehind * h, h,
                  [&](const CellIndex& c, double enter, double leave) {
                      if (!isOccupied(map_[c])) return true;
                      depth = 0.5 * (enter + leave);
                      stop = c;
                      return false;
                  });
        if (std::isnan(depth))
            return {isKnown(map_[cells_.cellAt(ray.end)]) ? RayEnd::missed : RayEnd::unknown,
                    kNotStopped};
        return {endOf((depth - beam.length) / h, stop), static_cast<float>(depth)};
    }

 private:
    /** \param error [cells] */
    RayEnd endOf(double error, const CellIndex& stop) {
        if (std::abs(error) <= kNear1) return RayEnd::near1;
        if (std::abs(error) <= kNear3) return RayEnd::near3;
        if (error > 0) return RayEnd::late;
        const bool is_surface =
            anyWithinOneCell(stop, [&](const CellIndex& c) { return returns_[c] > 0; });
        return is_surface ? RayEnd::grazed : RayEnd::phantom;
    }

    const OccupancyCells& cells_;
    OccupancyCells::Reader map_;
    ReturnCounts::Reader returns_;
};

}  // namespace

void countReturns(const std::vector<Ray>& rays, ReturnCounts& counts) {
    for (const Ray& ray : rays) counts[counts.cellAt(ray.end)]++;
}

std::vector<RayOutcome> castRays(const OccupancyCells& map, const ReturnCounts& returns,
                                 const std::vector<Ray>& rays) {
    constexpr std::size_t kGrain = 256;
    std::vector<RayOutcome> outcomes(rays.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, rays.size(), kGrain),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                          Caster caster(map, returns);
                          for (std::size_t i = range.begin(); i < range.end(); i++)
                              outcomes[i] = caster.cast(rays[i]);
                      });
    return outcomes;
}

void RayTally::add(const std::vector<Ray>& rays, const std::vector<RayOutcome>& outcomes) {
    for (std::size_t i = 0; i < rays.size(); i++) {
        rays_++;
        counts_[static_cast<std::size_t>(outcomes[i].end)]++;
        const double depth = static_cast<double>(outcomes[i].depth);
        if (!std::isnan(depth))
            errors_.push_back(static_cast<float>(std::abs(depth - Beam(rays[i]).length)));
    }
}

RayShares RayTally::shares() const {
    const auto share = [&](std::initializer_list<RayEnd> ends) {
        std::size_t count = 0;
        for (const RayEnd end : ends) count += counts_[static_cast<std::size_t>(end)];
        return static_cast<double>(count) / static_cast<double>(rays_);
    };
    RayShares s;
    s.near1 = share({RayEnd::near1});
    s.near3 = share({RayEnd::near1, RayEnd::near3});
    s.early = share({RayEnd::grazed, RayEnd::phantom});
    s.phantom = share({RayEnd::phantom});
    s.late = share({RayEnd::late});
    s.miss = share({RayEnd::missed, RayEnd::unknown});
    s.unknown = share({RayEnd::unknown});
    s.depth_error_median = quantile(errors_, 0.5);
    s.depth_error_90 = quantile(errors_, 0.9);
    return s;
}

const std::vector<RayFigure>& rayFigures() {
    static const std::vector<RayFigure> figures = {
        {"near1", "near1", &RayShares::near1, false},
        {"near3", "near3", &RayShares::near3, false},
        {"early", "early", &RayShares::early, false},
        {"phantom", "  phantom", &RayShares::phantom, false},
        {"late", "late", &RayShares::late, false},
        {"miss", "miss", &RayShares::miss, false},
        {"unknown", "  unknown", &RayShares::unknown, false},
        {"depth_error_median", "depth error [mm]", &RayShares::depth_error_median, true},
        {"depth_error_90", "  90th percentile", &RayShares::depth_error_90, true}};
    return figures;
}

}  // namespace akimap::app
