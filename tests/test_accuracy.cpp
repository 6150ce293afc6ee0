// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
// Accuracy gates. The floors of the built-in scenes are the first measured values less 0.005 AUC
// and plus 0.003 MSE; they may be tightened, never loosened.

#include <gtest/gtest.h>
#include <mrpt/maps/COctoMap.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CObservationPointCloud.h>

#include <cstdlib>
#include <filesystem>

#include "evaluation/evaluate.h"
#include "input/PcdReader.h"
#include "simulation/simulate.h"

using namespace akimap;
using namespace akimap::app;

namespace {

using Scans = std::vector<std::vector<Ray>>;

template <class Set>
Evaluation evaluateAkiMap(const Scans& scans, const Truth& truth, const Box& box, uint64_t seed,
                          Set&& set) {
    AkiMap map(truth.resolution);
    map.insertionOptions.seed = seed;
    set(map.insertionOptions);
    for (const auto& scan : scans) map.insertRays(scan);
    return evaluate(map, truth, box);
}

Evaluation evaluateOctoMap(const Scans& scans, const Truth& truth, const Box& box) {
    mrpt::maps::COctoMap map(truth.resolution);
    for (const auto& scan : scans) {  // at most 8 m long, as simulated
        const auto& o = scan.front().origin;
        mrpt::obs::CObservationPointCloud cloud;
        cloud.pointcloud = mrpt::maps::CSimplePointsMap::Create();
        for (const Ray& r : scan)
            cloud.pointcloud->insertPointFast(static_cast<float>(r.end[0] - o[0]),
                                              static_cast<float>(r.end[1] - o[1]),
                                              static_cast<float>(r.end[2] - o[2]));
        map.insertObservation(cloud, mrpt::poses::CPose3D(o[0], o[1], o[2], 0, 0, 0));
    }
    return evaluate(map, truth, box);
}

struct Gate {
    SceneKind scene;
    double resolution, auc, mse;  // of the known cells
};

class BuiltInScene : public testing::TestWithParam<Gate> {};

}  // namespace

TEST_P(BuiltInScene, BeatsOctoMapAndIsotropicKernelsAndHoldsItsFloor) {
    const Gate gate = GetParam();
    for (uint64_t seed = 1; seed <= 3; seed++) {
        SimulationOptions options;
        options.scene = gate.scene, options.seed = seed;
        const auto scans = simulatedRays(options);
        const auto truth = truthOf(*simulate(options).truth(gate.resolution));
        const auto b = scoringBox();
        const Box box{{b.min.x, b.min.y, b.min.z}, {b.max.x, b.max.y, b.max.z}};
        const auto ours = evaluateAkiMap(scans, truth, box, seed, [](auto&) {}).known;
        const auto isotropic = evaluateAkiMap(scans, truth, box, seed, [](auto& o) {
                                   o.estimator = Estimator::paper;
                                   o.bandwidth = Bandwidth::isotropic;
                               }).known;
        const auto octomap = evaluateOctoMap(scans, truth, box).known;
        EXPECT_GT(ours.auc, octomap.auc);
        EXPECT_LT(ours.mse, octomap.mse);
        EXPECT_LT(ours.mse, isotropic.mse);
        // At 10 cm wide isotropic kernels rank cells as well (0.976 to 0.980 here), if far less
        // sharply: doc/design.md.
        if (gate.resolution < 0.1) {
            EXPECT_GT(ours.auc, isotropic.auc);
        }
        EXPECT_GT(ours.auc, gate.auc) << "seed " << seed;
        EXPECT_LT(ours.mse, gate.mse) << "seed " << seed;
    }
}

INSTANTIATE_TEST_SUITE_P(Gates, BuiltInScene,
                         testing::Values(Gate{SceneKind::structured, 0.05, 0.9718, 0.0223},
                                         Gate{SceneKind::structured, 0.1, 0.9707, 0.0289},
                                         Gate{SceneKind::unstructured, 0.05, 0.9698, 0.0194},
                                         Gate{SceneKind::unstructured, 0.1, 0.9687, 0.0275}));

/** LA3DM's structured scene: the default, and the authors' ball for a search region. */
class La3dmStructured : public testing::TestWithParam<SearchRegion> {};

TEST_P(La3dmStructured, HoldsThePapersFigures) {
    const char* data = std::getenv("AKIMAP_DATA");
    const std::string folder = std::string(data ? data : "") + "/la3dm/sim_structured/";
    if (!data || !std::filesystem::exists(folder + "truth_5cm.bt"))
        GTEST_SKIP() << "no la3dm/sim_structured/truth_5cm.bt in AKIMAP_DATA";
    Scans scans;
    for (int i = 1; i <= 12; i++)
        scans.push_back(readPcd(folder + "sim_structured_" + std::to_string(i) + ".pcd"));
    const Truth truth = readTruth(folder + "truth_5cm.bt");
    Evaluation mean{};
    constexpr int kSeeds = 10;
    for (uint64_t seed = 1; seed <= kSeeds; seed++) {
        const auto e =
            evaluateAkiMap(scans, truth, {{0, 0, 0}, {7.25, 10.2, 2.1}}, seed, [](auto& o) {
                o.estimator = Estimator::paper;
                o.search_region = GetParam();
            });
        mean.known.auc += e.known.auc / kSeeds, mean.known.mse += e.known.mse / kSeeds;
        mean.known.occupied.precision += e.known.occupied.precision / kSeeds;
        mean.known.free.precision += e.known.free.precision / kSeeds;
        mean.all.auc += e.all.auc / kSeeds, mean.all.mse += e.all.mse / kSeeds;
    }
    EXPECT_GE(mean.known.auc, 0.92);
    EXPECT_LE(mean.known.mse, 0.045);
    EXPECT_GE(mean.known.occupied.precision, 0.68);
    EXPECT_GE(mean.known.free.precision, 0.98);
    EXPECT_GE(mean.all.auc, 0.85);
    EXPECT_LE(mean.all.mse, 0.116);
}

INSTANTIATE_TEST_SUITE_P(BoxAndBall, La3dmStructured,
                         testing::Values(SearchRegion::box, SearchRegion::ball));
