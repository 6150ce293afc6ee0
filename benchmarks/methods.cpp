// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "methods.h"

#include <mrpt/maps/COccupancyGridMap3D.h>
#include <mrpt/maps/COctoMap.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/system/CTicTac.h>

#include <algorithm>
#include <cmath>

#include "rivals/BgkLOctoMap.h"
#include "rivals/BgkOctoMap.h"
#include "rivals/GmmMap.h"

#if __has_include(<mrpt/maps/CVoxelMap.h>)
#include <mrpt/maps/CVoxelMap.h>
#endif

namespace akimap::bench {
namespace {

float toFloat(double v) {
    return static_cast<float>(v);
}

class AkiMapUnderTest : public MapUnderTest {
 public:
    AkiMapUnderTest(const MapSettings& s, const std::function<void(InsertionParameters&)>& set)
        : map_(s.resolution) {
        map_.insertionOptions.max_range = s.max_range, map_.insertionOptions.seed = s.seed;
        map_.insertionOptions.threads = s.threads;
        set(map_.insertionOptions);
    }
    void insert(const PreparedScan& scan) override { map_.insertRays(scan.rays); }
    std::optional<double> occupancy(double x, double y, double z) const override {
        return map_.occupancy(x, y, z);
    }

 private:
    AkiMap map_;
};

/** By the map's own insertObservation() and getPointOccupancy(). */
template <class Map>
class MrptTree : public MapUnderTest {
 public:
    explicit MrptTree(const MapSettings& s) : map_(s.resolution) {}
    void insert(const PreparedScan& scan) override {
        map_.insertObservation(scan.cloud.observation, scan.cloud.robot);
    }
    std::optional<double> occupancy(double x, double y, double z) const override {
        double p = 0;
        if (!map_.getPointOccupancy(toFloat(x), toFloat(y), toFloat(z), p)) return std::nullopt;
        return p;
    }

 private:
    Map map_;
};

/** Takes no CObservationPointCloud: the cloud goes in by insertPointCloud(). */
class MrptGrid3D : public MapUnderTest {
 public:
    explicit MrptGrid3D(const MapSettings& s) {
        const auto& [low, high] = std::pair(s.box.min, s.box.max);
        map_.setSize({low[0], low[1], low[2]}, {high[0], high[1], high[2]}, s.resolution);
    }
    void insert(const PreparedScan& scan) override {
        mrpt::maps::CSimplePointsMap points;
        for (const Ray& r : scan.rays)
            points.insertPointFast(static_cast<float>(r.end[0]), static_cast<float>(r.end[1]),
                                   static_cast<float>(r.end[2]));
        map_.insertPointCloud(scan.cloud.robot.translation(), points);
    }
    /** A voxel never updated has exactly the log-odds 0. */
    std::optional<double> occupancy(double x, double y, double z) const override {
        const double p =
            1.0 - static_cast<double>(map_.getFreenessByPos(toFloat(x), toFloat(y), toFloat(z)));
        if (p == 0.5) return std::nullopt;
        return p;
    }

 private:
    mrpt::maps::COccupancyGridMap3D map_;
};

class RivalUnderTest : public MapUnderTest {
 public:
    explicit RivalUnderTest(std::unique_ptr<Rival> map) : map_(std::move(map)) {}
    void insert(const PreparedScan& scan) override { map_->insert(scan.rays); }
    std::optional<double> occupancy(double x, double y, double z) const override {
        return map_->occupancy(x, y, z);
    }

 private:
    std::unique_ptr<Rival> map_;
};

BgkOptions fitted(BgkOptions options, const MapSettings& s) {
    options.resolution = s.resolution, options.max_range = s.max_range;
    return options;
}

/** Of all rays, with half a metre about them. */
app::Box boundsOf(const std::vector<std::vector<Ray>>& scans) {
    app::Box box{{1e9, 1e9, 1e9}, {-1e9, -1e9, -1e9}};
    for (const auto& scan : scans)
        for (const Ray& r : scan)
            for (std::size_t i = 0; i < 3; i++) {
                box.min[i] = std::min({box.min[i], double(r.origin[i]), double(r.end[i]) - 0.5});
                box.max[i] = std::max({box.max[i], double(r.origin[i]), double(r.end[i]) + 0.5});
            }
    return box;
}

}  // namespace

std::vector<PreparedScan> prepare(const std::vector<std::vector<Ray>>& scans, double max_range) {
    std::vector<PreparedScan> prepared;
    for (const auto& scan : scans) {
        PreparedScan p;
        for (const Ray& r : scan)
            if (std::hypot(r.end[0] - r.origin[0], r.end[1] - r.origin[1],
                           r.end[2] - r.origin[2]) <= max_range)
                p.rays.push_back(r);
        p.cloud = asPointCloud(p.rays);
        prepared.push_back(std::move(p));
    }
    return prepared;
}

MapSettings settingsFor(const Scene& scene, uint64_t seed) {
    MapSettings s;
    if (!scene.truth.leaves.empty()) s.resolution = scene.truth.resolution;
    s.max_range = scene.max_range, s.seed = seed;
    s.box = boundsOf(scene.scans);
    return s;
}

Method akimapMethod(const std::string& name, const std::string& what,
                    const std::function<void(InsertionParameters&)>& set) {
    return {name, what, true,
            [set](const MapSettings& s) { return std::make_unique<AkiMapUnderTest>(s, set); }};
}

std::vector<Method> akimapMethods() {
    return {akimapMethod("AkiMap", "akimap::AkiMap with its defaults", [](auto&) {}),
            akimapMethod("AkiMap, paper", "estimator = paper: the paper's method",
                         [](auto& o) { o.estimator = Estimator::paper; }),
            akimapMethod("AkiMap, covariance", "bandwidth = covariance: no Eq. 7",
                         [](auto& o) {
                             o.estimator = Estimator::paper, o.bandwidth = Bandwidth::covariance;
                         }),
            akimapMethod("AkiMap, isotropic", "bandwidth = isotropic, isotropic_length = 0.2 m",
                         [](auto& o) {
                             o.estimator = Estimator::paper, o.bandwidth = Bandwidth::isotropic;
                         })};
}

std::vector<Method> otherMethods() {
    using mrpt::maps::COctoMap;
    std::vector<Method> methods;
    methods.push_back(
        {"COctoMap", "MRPT's, its defaults, by insertObservation()", false,
         [](const MapSettings& s) { return std::make_unique<MrptTree<COctoMap>>(s); }});
    methods.push_back({"COccupancyGridMap3D", "MRPT's, its defaults, by insertPointCloud()", false,
                       [](const MapSettings& s) { return std::make_unique<MrptGrid3D>(s); }});
#if __has_include(<mrpt/maps/CVoxelMap.h>)
    using mrpt::maps::CVoxelMap;
    methods.push_back(
        {"CVoxelMap", "MRPT's, its defaults, by insertObservation()", false,
         [](const MapSettings& s) { return std::make_unique<MrptTree<CVoxelMap>>(s); }});
#endif
    methods.push_back({"BGKOctoMap", "ours after LA3DM's: kernel 0.2 m, a free sample each 0.5 m",
                       false, [](const MapSettings& s) {
                           return std::make_unique<RivalUnderTest>(
                               std::make_unique<BgkOctoMap>(fitted({}, s)));
                       }});
    methods.push_back({"BGKOctoMap-L", "ours after LA3DM's: kernel 0.2 m, free segments, 0.3 m",
                       false, [](const MapSettings& s) {
                           return std::make_unique<RivalUnderTest>(
                               std::make_unique<BgkLOctoMap>(fitted(BgkLOctoMap::defaults(), s)));
                       }});
    methods.push_back(
        {"GMM-OM",
         "ours: 70 Gaussians a scan by EM, 83,333 resamples a scan, ray-cast; its sensor "
         "model is chosen such that the structured scene's figures come near the paper's",
         true,
         [](const MapSettings& s) {
             GmmOptions o;
             o.resolution = s.resolution, o.seed = s.seed;
             return std::make_unique<RivalUnderTest>(std::make_unique<GmmMap>(o));
         },
         3});
    return methods;
}

std::size_t runsOf(const Method& method, std::size_t recordings, int seeds) {
    const auto of_one = method.random ? static_cast<std::size_t>(seeds) : 1;
    return std::min(recordings > 1 ? recordings : of_one, method.most_runs);
}

BuiltMap build(const Method& method, const MapSettings& settings,
               const std::vector<PreparedScan>& scans) {
    BuiltMap built{method.make(settings), 0};
    mrpt::system::CTicTac clock;
    for (const PreparedScan& scan : scans) built.map->insert(scan);
    built.seconds = clock.Tac();
    return built;
}

app::OccupancyLookup lookupIn(const MapUnderTest& map) {
    return [&map](double x, double y, double z) { return map.occupancy(x, y, z); };
}

}  // namespace akimap::bench
