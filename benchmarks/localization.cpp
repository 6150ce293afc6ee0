// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "localization.h"

#include <akimap/AkiMap.h>
#include <mrpt/maps/COctoMap.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/slam/CICP.h>
#include <mrpt/system/CTicTac.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "evaluation/holdout.h"
#include "evaluation/octomap_scan.h"
#include "simulation/Random.h"

namespace akimap::bench {
namespace {

using mrpt::maps::CMetricMap;
using mrpt::maps::CSimplePointsMap;
using mrpt::poses::CPose3D;

struct NamedMetricMap {
    std::string name;
    CMetricMap& map;
    bool matches_points;
};

/** The maps of one recording. */
struct Maps {
    explicit Maps(const LocalizationCase& c) : octomap(c.resolution), akimap(c.resolution) {
        akimap.insertionOptions.max_range = c.max_range;
        points.likelihoodOptions.decimation = 1;  // as the others
    }
    void insert(const std::vector<Ray>& rays) {
        for (const Ray& r : rays)
            points.insertPointFast(static_cast<float>(r.end[0]), static_cast<float>(r.end[1]),
                                   static_cast<float>(r.end[2]));
        points.mark_as_modified();
        const auto scan = app::asPointCloud(rays);
        octomap.insertObservation(scan.observation, scan.robot);
        akimap.insertRays(rays);
    }
    CSimplePointsMap points;
    mrpt::maps::COctoMap octomap;
    AkiMap akimap;
};

/** A scan to find, in its sensor's frame, and where to start. */
struct Search {
    mrpt::obs::CObservationPointCloud observation;
    CPose3D truth;
    std::vector<CPose3D> starts;

    [[nodiscard]] const CSimplePointsMap& cloud() const {
        return dynamic_cast<const CSimplePointsMap&>(*observation.pointcloud);
    }
};

std::vector<Ray> within(const std::vector<Ray>& rays, double max_range) {
    InsertionParameters ranges;
    ranges.max_range = max_range;
    return app::raysInRange(rays, ranges);
}

Search searchFor(const PosedScan& scan, const LocalizationCase& c, const LocalizationRules& rules,
                 std::size_t starts, app::Random& random) {
    Search search;
    search.truth = scan.sensor;
    const auto cloud = CSimplePointsMap::Create();
    const std::vector<Ray> rays = within(scan.rays, c.max_range);
    const std::size_t step = std::max<std::size_t>(1, rays.size() / rules.returns);
    for (std::size_t i = 0; i < rays.size(); i += step) {
        std::array<double, 3> p{};
        scan.sensor.inverseComposePoint(rays[i].end[0], rays[i].end[1], rays[i].end[2], p[0], p[1],
                                        p[2]);
        cloud->insertPointFast(static_cast<float>(p[0]), static_cast<float>(p[1]),
                               static_cast<float>(p[2]));
    }
    cloud->mark_as_modified();
    search.observation.pointcloud = cloud;
    for (std::size_t i = 0; i < starts; i++) {
        std::array<double, 6> off{};
        for (std::size_t k = 0; k < off.size(); k++) {
            const double most = k < 3 ? rules.offset : rules.angle;
            off[k] = random.uniform(-most, most);
        }
        search.starts.push_back(scan.sensor +
                                CPose3D(off[0], off[1], off[2], off[3], off[4], off[5]));
    }
    return search;
}

CPose3D byIcp(const CMetricMap& map, const Search& search, const CPose3D& start) {
    mrpt::slam::CICP icp;
    icp.options.maxIterations = 200, icp.options.thresholdDist = 0.5f;
    icp.options.thresholdAng = 0.05f, icp.options.ALFA = 0.8f;
    icp.options.smallestThresholdDist = 0.04f, icp.options.skip_cov_calculation = true;
    icp.options.corresponding_points_decimation = 1;
    icp.options.minAbsStep_trans = 2e-4f, icp.options.minAbsStep_rot = 1e-4f;
    return icp.Align3D(&map, &search.cloud(), start)->getMeanVal();
}

/** Climbs from the start: along each axis a step up or down if that is more likely, half as far
 * when none is. */
CPose3D byLikelihood(CMetricMap& map, const Search& search, const CPose3D& start) {
    constexpr double kSmallest = 0.002;  // [m]
    constexpr double kTurn = 0.5;        // [rad/m] of a step in angle to one in place
    CPose3D best = start;
    double most = map.computeObservationLikelihood(search.observation, best);
    for (double step = 0.1; step > kSmallest;) {
        bool has_moved = false;
        for (std::size_t axis = 0; axis < 6; axis++)
            for (const double sign : {-1., 1.}) {
                std::array<double, 6> move{};
                move[axis] = sign * step * (axis < 3 ? 1 : kTurn);
                const CPose3D next =
                    best + CPose3D(move[0], move[1], move[2], move[3], move[4], move[5]);
                const double likelihood =
                    map.computeObservationLikelihood(search.observation, next);
                if (likelihood <= most) continue;
                best = next, most = likelihood, has_moved = true;
            }
        if (!has_moved) step /= 2;
    }
    return best;
}

void add(PoseEstimates& estimates, const CPose3D& estimate, const CPose3D& truth, double seconds) {
    const CPose3D error = estimate - truth;
    const double cosine = (error.getRotationMatrix().trace() - 1) / 2;
    estimates.metres.push_back(error.norm());
    estimates.radians.push_back(std::acos(std::clamp(cosine, -1., 1.)));
    estimates.seconds.push_back(seconds);
}

template <class Method>
PoseEstimates estimatesOf(const std::string& name, const NamedMetricMap& map, Method&& method,
                          const std::vector<Search>& searches) {
    PoseEstimates estimates{name, map.name, {}, {}, {}};
    for (const Search& search : searches)
        for (const CPose3D& start : search.starts) {
            mrpt::system::CTicTac clock;
            const CPose3D pose = method(map.map, search, start);
            add(estimates, pose, search.truth, clock.Tac());
        }
    return estimates;
}

}  // namespace

double PoseEstimates::good() const {
    constexpr double kMetres = 0.05, kRadians = 2 * M_PI / 180;
    if (metres.empty()) return std::numeric_limits<double>::quiet_NaN();
    std::size_t count = 0;
    for (std::size_t i = 0; i < metres.size(); i++)
        count += metres[i] < kMetres && radians[i] < kRadians ? 1 : 0;
    return static_cast<double>(count) / static_cast<double>(metres.size());
}

std::vector<PoseEstimates> localize(const LocalizationCase& recording,
                                    const LocalizationRules& rules,
                                    const std::function<void(const std::string&)>& doing) {
    if (recording.scans.size() < rules.every)
        throw std::runtime_error(recording.name + ": " + std::to_string(recording.scans.size()) +
                                 " scans, none of them to look for");
    Maps maps(recording);
    std::vector<Search> searches;
    app::Random random(rules.seed, 12);
    const std::size_t starts =
        std::max<std::size_t>(1, rules.starts / (recording.scans.size() / rules.every));
    doing(recording.name + ", localization: maps");
    for (std::size_t i = 0; i < recording.scans.size(); i++) {
        const PosedScan& scan = recording.scans[i];
        if (app::isHeldOut(i, rules.every))
            searches.push_back(searchFor(scan, recording, rules, starts, random));
        else
            maps.insert(within(scan.rays, recording.max_range));
    }
    const NamedMetricMap all[] = {{"AkiMap", maps.akimap, true},
                                  {"CSimplePointsMap", maps.points, true},
                                  {"COctoMap", maps.octomap, false}};
    std::vector<PoseEstimates> estimates;
    for (const NamedMetricMap& map : all) {
        doing(recording.name + ", localization: " + map.name);
        estimates.push_back(map.matches_points ? estimatesOf("ICP", map, byIcp, searches)
                                               : PoseEstimates{"ICP", map.name, {}, {}, {}});
        if (map.map.canComputeObservationLikelihood(searches.front().observation))
            estimates.push_back(estimatesOf("likelihood", map, byLikelihood, searches));
        else
            estimates.push_back({"likelihood", map.name, {}, {}, {}});
    }
    return estimates;
}

std::vector<LocalizationCase> localizationCases() {
    std::vector<LocalizationCase> cases = {
        {"RGB-D office, 5 cm cells", depthFrames(dataFolder("rgbd_office")), 0.05, 4},
        {"Dense lidar, 10 cm cells, 30 m", posedClouds(dataFolder("lidar_dense")), 0.10, 30}};
    const auto is_absent = [](const LocalizationCase& c) { return c.scans.empty(); };
    cases.erase(std::remove_if(cases.begin(), cases.end(), is_absent), cases.end());
    return cases;
}

}  // namespace akimap::bench
