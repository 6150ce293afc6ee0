// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "evaluation/contest/entrants.h"

#include <octomap/OcTree.h>

#include <algorithm>

#include "evaluation/rivals/TsdfMap.h"

namespace akimap::app {

namespace {

class AkiMapContestant : public Contestant {
 public:
    explicit AkiMapContestant(const AkiMap& configured) : map_(configured) {}
    void insert(const ContestScan& scan) override { map_.insertRays(scan.all); }
    OccupancyCells cells() override { return cellsOf(map_); }

 private:
    AkiMap map_;
};

octomap::point3d pointOf(const std::array<double, 3>& p) {
    return {static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])};
}

class OctoMapContestant : public Contestant {
 public:
    explicit OctoMapContestant(double resolution) : tree_(resolution) {}
    /** One cloud for each run of rays of the same origin, of which a moving sensor has many. */
    void insert(const ContestScan& scan) override {
        for (auto begin = scan.returns.begin(); begin != scan.returns.end();) {
            const auto end = std::find_if(begin, scan.returns.end(),
                                          [&](const Ray& r) { return r.origin != begin->origin; });
            insertCloud(begin, end);
            begin = end;
        }
    }
    OccupancyCells cells() override { return cellsOf(tree_); }

 private:
    using Place = std::vector<Ray>::const_iterator;
    /** OctoMap's grid ends 2^15 cells from its centre; it prints a warning for what lies beyond. */
    [[nodiscard]] bool covers(const std::array<double, 3>& p) const {
        octomap::OcTreeKey key;
        return tree_.coordToKeyChecked(pointOf(p), key);
    }
    void insertCloud(Place begin, Place end) {
        constexpr double kNoLimit = -1;
        constexpr bool kLazily = true, kDiscretized = true;
        if (!covers(begin->origin)) return;
        octomap::Pointcloud cloud;
        for (auto ray = begin; ray != end; ++ray)
            if (covers(ray->end)) cloud.push_back(pointOf(ray->end));
        tree_.insertPointCloud(cloud, pointOf(begin->origin), kNoLimit, kLazily, kDiscretized);
    }

    octomap::OcTree tree_;
};

class TsdfContestant : public Contestant {
 public:
    explicit TsdfContestant(double resolution) : map_(resolution) {}
    void insert(const ContestScan& scan) override { map_.insert(scan.returns); }
    OccupancyCells cells() override { return cellsOf(map_); }

 private:
    TsdfMap map_;
};

}  // namespace

Entrant akimapEntrant(const std::string& name, const std::string& what, const AkiMap& configured) {
    return {name, what, [configured] { return std::make_unique<AkiMapContestant>(configured); }};
}

Entrant octomapEntrant(double resolution) {
    return {"OctoMap", "its library's insertPointCloud(), discretized",
            [=] { return std::make_unique<OctoMapContestant>(resolution); }};
}

Entrant tsdfEntrant(double resolution) {
    return {"TSDF", "a plain truncated signed distance field",
            [=] { return std::make_unique<TsdfContestant>(resolution); }};
}

std::vector<Entrant> standardEntrants(const AkiMap& configured) {
    AkiMap paper = configured, isotropic = configured;
    paper.insertionOptions.estimator = isotropic.insertionOptions.estimator = Estimator::paper;
    paper.insertionOptions.bandwidth = Bandwidth::adaptive;
    isotropic.insertionOptions.bandwidth = Bandwidth::isotropic;
    const double resolution = configured.resolution();
    Entrant yardstick = octomapEntrant(resolution);
    yardstick.name = "OctoMap+";
    yardstick.what = "OctoMap that also got the held-out scans: what is possible";
    yardstick.sees_held_out = true;
    return {
        akimapEntrant("AkiMap", "AkiMap as configured", configured),
        akimapEntrant("paper", "AkiMap, estimator = paper: the paper's method", paper),
        akimapEntrant("isotropic", "AkiMap, estimator = paper, bandwidth = isotropic", isotropic),
        octomapEntrant(resolution),
        tsdfEntrant(resolution),
        yardstick};
}

}  // namespace akimap::app
