// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
// SLAM with an AkiMap beside MRPT's own maps: the cost of a likelihood, localization by particles
// and ICP. Times are from one run: quote their ratios.

#include <mrpt/config/CConfigFileMemory.h>
#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/io/vector_loadsave.h>
#include <mrpt/maps/CMultiMetricMap.h>
#include <mrpt/maps/COctoMap.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CRawlog.h>
#include <mrpt/random/RandomGenerators.h>
#include <mrpt/serialization/CArchive.h>
#include <mrpt/slam/CICP.h>
#include <mrpt/slam/CMonteCarloLocalization2D.h>
#include <mrpt/system/CTicTac.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>

#include "slam_scenes.h"

using namespace akimap;
using mrpt::poses::CPose2D;
using mrpt::poses::CPose3D;

namespace {

double median(std::vector<double> v) {
    std::sort(v.begin(), v.end());
    return v.empty() ? NAN : v[v.size() / 2];
}

// The cost of a likelihood -----------------------------------------------------------------

double microseconds(const mrpt::maps::CMetricMap& map, const mrpt::obs::CObservation& scan) {
    app::Random random(1, 0);
    constexpr int kPoses = 2000;
    double sum = 0;
    mrpt::system::CTicTac clock;
    for (int i = 0; i < kPoses; i++)
        sum += map.computeObservationLikelihood(
            scan, CPose3D(random.uniform(-2, 2), random.uniform(-2, 2), 0,
                          random.uniform(-M_PI, M_PI), 0, 0));
    const double t = 1e6 * clock.Tac() / kPoses;
    return std::isfinite(sum) ? t : NAN;
}

void likelihoodCost() {
    const auto scans = bench::flatScans(1);
    AkiMap aki(0.05);
    mrpt::maps::COctoMap octo(0.05);
    for (const auto& s : scans) {
        aki.insertObservation(*s.observation, CPose3D(s.robot));
        octo.insertObservation(*s.observation, CPose3D(s.robot));
    }
    std::vector<double> a, o;
    for (int i = 0; i < 7; i++) {
        o.push_back(microseconds(octo, *scans[0].observation));
        a.push_back(microseconds(aki, *scans[0].observation));
    }
    std::printf("Likelihood of one 360-beam scan, medians of 7 rounds of 2000 poses\n");
    std::printf("  COctoMap  %6.1f us\n  AkiMap    %6.1f us   %.2f x COctoMap's\n\n", median(o),
                median(a), median(a) / median(o));
}

// Localization by particles ------------------------------------------------------------------

struct Localization {
    CPose2D estimate;
    double seconds;
};

struct Demo {
    mrpt::config::CConfigFileMemory ini;
    mrpt::maps::CSimpleMap keyframes;
    mrpt::obs::CRawlog rawlog;
};

Demo loadDemo() {
    const char* shared = std::getenv("MRPT_SHARE");
    const std::string folder = shared ? shared : "/usr/share/mrpt";
    Demo d;
    d.ini.setContent(mrpt::io::file_get_contents(
        folder + "/config_files/pf-localization/localization_demo.ini"));
    mrpt::io::CFileGZInputStream stream(folder + "/datasets/localization_demo.simplemap.gz");
    mrpt::serialization::archiveFrom(stream) >> d.keyframes;
    if (!d.rawlog.loadFromRawLogFile(folder + "/datasets/localization_demo.rawlog"))
        throw std::runtime_error(folder + "/datasets/localization_demo.rawlog: can't be read");
    return d;
}

mrpt::maps::CMultiMetricMap::Ptr mapOf(const Demo& demo, const std::string& ini) {
    mrpt::config::CConfigFileMemory config;
    config.setContent(ini);
    mrpt::maps::TSetOfMetricMapInitializers list;
    list.loadFromConfigFile(config, "MetricMap");
    auto map = mrpt::maps::CMultiMetricMap::Create();
    map->setListOfMaps(list);
    map->loadFromSimpleMap(demo.keyframes);
    return map;
}

Localization localize(const Demo& demo, const mrpt::maps::CMultiMetricMap::Ptr& map,
                      unsigned seed) {
    mrpt::random::getRandomGenerator().randomize(seed);
    mrpt::slam::CMonteCarloLocalization2D particles;
    particles.options.metricMap = map;
    particles.options.KLD_params.loadFromConfigFile(demo.ini, "KLD_options");
    particles.resetUniform(-10, 10, -15, -5, -M_PI, M_PI, 40000);
    mrpt::bayes::CParticleFilter filter;
    filter.m_options.loadFromConfigFile(demo.ini, "PF_options");
    mrpt::system::CTicTac clock;
    std::size_t entry = 0;
    mrpt::obs::CActionCollection::Ptr action;
    mrpt::obs::CSensoryFrame::Ptr frame;
    while (entry < demo.rawlog.size() && demo.rawlog.getActionObservationPair(action, frame, entry))
        filter.executeOn(particles, action.get(), frame.get());
    return {CPose2D(particles.getMeanVal()), clock.Tac()};
}

/** Where the last scan fits best into a points map of the keyframes, by ICP from about there: a
 * truth that favours no likelihood. */
CPose2D lastPose(const Demo& demo) {
    const CPose2D about_there(15.9, -10, 0.08);
    mrpt::maps::CSimplePointsMap map, scan;
    map.insertionOptions.minDistBetweenLaserPoints = 0;
    map.loadFromSimpleMap(demo.keyframes);
    std::size_t entry = 0;
    mrpt::obs::CActionCollection::Ptr action;
    mrpt::obs::CSensoryFrame::Ptr frame, last;
    while (entry < demo.rawlog.size() && demo.rawlog.getActionObservationPair(action, frame, entry))
        last = frame;
    last->insertObservationsInto(scan);
    mrpt::slam::CICP icp;
    icp.options.maxIterations = 200, icp.options.thresholdDist = 0.5f;
    icp.options.smallestThresholdDist = 0.05f, icp.options.corresponding_points_decimation = 1;
    return CPose2D(icp.Align(&map, &scan, about_there)->getMeanVal());
}

/** \param only  the class of the only map to try, or empty for all */
void localization(const std::string& only) {
    Demo demo = loadDemo();
    const char* extra = std::getenv("AKIMAP_LIKELIHOOD");  // to try options: "p_unknown=0.2\n..."
    const std::map<std::string, std::string> inis{
        {"COccupancyGridMap2D", demo.ini.getContent()},
        {"CSimplePointsMap",
         "[MetricMap]\npointsMap_count=1\n"
         "[MetricMap_pointsMap_00_insertOpts]\n"
         "minDistBetweenLaserPoints=0.06\n"},
        {"AkiMap",
         std::string("[MetricMap]\nakimap_count=1\n"
                     "[MetricMap_akimap_00_creationOpts]\nresolution=0.06\n"
                     "[MetricMap_akimap_00_insertOpts]\nmax_range=15\n"
                     "[MetricMap_akimap_00_likelihoodOpts]\ndecimation=5\nsigma_hit=0.15\n") +
             (extra ? extra : "")}};
    std::printf(
        "Monte-Carlo localization, localization_demo, 40000 particles over 20 x 10 m, 10 "
        "seeds\n  %-20s %9s %14s %10s %8s\n",
        "the only map", "successes", "median error", "worst", "time");
    const CPose2D truth = lastPose(demo);
    for (const char* name : {"COccupancyGridMap2D", "CSimplePointsMap", "AkiMap"}) {
        if (!only.empty() && only != name) continue;
        const auto map = mapOf(demo, inis.at(name));
        std::vector<Localization> runs;
        for (unsigned seed = 1; seed <= 10; seed++) runs.push_back(localize(demo, map, seed));
        std::vector<double> good, seconds;
        for (const auto& r : runs) {
            const double error = r.estimate.distanceTo(truth);
            seconds.push_back(r.seconds);
            if (error < 0.5) good.push_back(error);
        }
        std::printf("  %-20s %6zu/10 %12.3f m %8.3f m %6.2f s\n", name, good.size(), median(good),
                    good.empty() ? NAN : *std::max_element(good.begin(), good.end()),
                    median(seconds));
    }
    std::printf("\n");
}

// ICP ----------------------------------------------------------------------------------------

struct Tally {
    std::vector<double> meters, degrees, seconds;
    std::vector<bool> good;
    void add(const CPose3D& estimate, const CPose3D& truth, double t) {
        const CPose3D e = estimate - truth;
        const double d = e.norm(), trace = e.getRotationMatrix().trace();
        const double angle = std::acos(std::clamp((trace - 1) / 2, -1.0, 1.0)) * 180 / M_PI;
        meters.push_back(d), degrees.push_back(angle), seconds.push_back(t);
        good.push_back(d < 0.02 && angle < 0.5);
    }
};

CPose3D align(const bench::IcpCase& c, const mrpt::maps::CMetricMap& map,
              const bench::IcpQuery& q) {
    mrpt::slam::CICP icp;
    icp.options.maxIterations = 300, icp.options.thresholdDist = 1.0f;
    icp.options.thresholdAng = 0.05f, icp.options.ALFA = 0.8f;
    icp.options.smallestThresholdDist = 0.04f, icp.options.skip_cov_calculation = true;
    icp.options.corresponding_points_decimation = 1;
    icp.options.minAbsStep_trans = 2e-4f, icp.options.minAbsStep_rot = 1e-4f;
    if (c.flat) return CPose3D(icp.Align(&map, &q.cloud, CPose2D(q.guess))->getMeanVal());
    return icp.Align3D(&map, &q.cloud, q.guess)->getMeanVal();
}

void icp(const bench::IcpCase& c) {
    Tally points, aki;
    for (const auto& q : c.queries) {
        mrpt::system::CTicTac clock;
        const CPose3D by_points = align(c, c.points, q);
        points.add(by_points, q.truth, clock.Tac());
        clock.Tic();
        const CPose3D by_aki = align(c, c.aki, q);
        aki.add(by_aki, q.truth, clock.Tac());
    }
    int both = 0, p = 0, a = 0;
    for (std::size_t i = 0; i < c.queries.size(); i++)
        p += points.good[i], a += aki.good[i], both += points.good[i] && aki.good[i];
    std::printf("  %-34s %3d/%zu %3d/%zu %4d/%-3d %7.1f %7.1f %8.2f %6.2f %8.2f %6.2f\n",
                c.name.c_str(), p, c.queries.size(), a, c.queries.size(), both, p,
                1e3 * median(points.meters), 1e3 * median(aki.meters), median(points.degrees),
                median(aki.degrees), median(points.seconds), median(aki.seconds));
}

}  // namespace

int main(int argc, char** argv) try {
    const std::string only = argc > 1 ? argv[1] : "";
    std::setvbuf(stdout, nullptr, _IOLBF, BUFSIZ);
    registerClasses();
    if (only.empty() || only == "likelihood") likelihoodCost();
    if (only.empty() || only == "localization") localization(argc > 2 ? argv[2] : "");
    if (!only.empty() && only != "icp") return 0;
    std::printf(
        "ICP (CICP) from 50 offsets up to 0.3 m and 10 deg; good: within 2 cm and 0.5 deg\n"
        "  %-34s %6s %6s %8s  median mm      median deg     median s\n"
        "  %-34s %6s %6s %8s  points    Aki   points    Aki   points    Aki\n",
        "", "points", "Aki", "Aki", "map in the frame of", "good", "good", "of those");
    for (const auto& c : bench::icpCases()) icp(*c);
    return 0;
} catch (const std::exception& e) {
    std::fprintf(stderr, "bench_slam: %s\n", e.what());
    return 1;
}
