// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
// Accuracy gates. The floors are the measured values less 0.002 AUC and plus 0.001 MSE; they
// may be tightened, never loosened.

#include <gtest/gtest.h>
#include <mrpt/maps/COctoMap.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CObservationPointCloud.h>

#include <cstdlib>
#include <filesystem>

#include "evaluation/contest/contest.h"
#include "evaluation/evaluate.h"
#include "input/clouds/PcdReader.h"
#include "sanitized.h"
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

void PrintTo(const Gate& g, std::ostream* out) {
    *out << (g.scene == SceneKind::structured ? "structured " : "unstructured ") << g.resolution;
}

class BuiltInScene : public testing::TestWithParam<Gate> {};

Scans la3dmStructured(const std::string& folder) {
    Scans scans;
    for (int i = 1; i <= 12; i++)
        scans.push_back(readPcd(folder + "sim_structured_" + std::to_string(i) + ".pcd"));
    return scans;
}
/** The folder with its truth; empty if it is not there. */
std::string la3dmFolder() {
    const char* data = std::getenv("AKIMAP_DATA");
    const std::string folder = std::string(data ? data : "") + "/la3dm/sim_structured/";
    return data && std::filesystem::exists(folder + "truth_5cm.bt") ? folder : "";
}
constexpr const char* kNoLa3dm = "no la3dm/sim_structured/truth_5cm.bt in AKIMAP_DATA";
const Box kLa3dmRoom{{0, 0, 0}, {7.25, 10.2, 2.1}};

}  // namespace

TEST_P(BuiltInScene, BeatsOctoMapAndIsotropicKernelsAndHoldsItsFloor) {
    const Gate gate = GetParam();
    for (uint64_t seed = 1; seed <= (sanitized() ? 1 : 3); seed++) {
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
                         testing::Values(Gate{SceneKind::structured, 0.05, 0.987, 0.0112},
                                         Gate{SceneKind::structured, 0.1, 0.982, 0.033},
                                         Gate{SceneKind::unstructured, 0.05, 0.988, 0.0116},
                                         Gate{SceneKind::unstructured, 0.1, 0.987, 0.03}));

/** LA3DM's structured scene: the default, and the authors' ball for a search region. */
class La3dmStructured : public testing::TestWithParam<SearchRegion> {};

TEST_P(La3dmStructured, HoldsThePapersFigures) {
    const std::string folder = la3dmFolder();
    if (folder.empty()) GTEST_SKIP() << kNoLa3dm;
    const Scans scans = la3dmStructured(folder);
    const Truth truth = readTruth(folder + "truth_5cm.bt");
    Evaluation mean{};
    constexpr int kSeeds = sanitized() ? 1 : 10;
    for (uint64_t seed = 1; seed <= kSeeds; seed++) {
        const auto e = evaluateAkiMap(scans, truth, kLa3dmRoom, seed, [](auto& o) {
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

TEST(La3dm, TheDefaultHoldsItsFigures) {
    const std::string folder = la3dmFolder();
    if (folder.empty()) GTEST_SKIP() << kNoLa3dm;
    const Truth truth = readTruth(folder + "truth_5cm.bt");
    Scans scans = la3dmStructured(folder);
    const auto evaluation = [&] {
        return evaluateAkiMap(scans, truth, kLa3dmRoom, 1, [](auto&) {});
    };
    const Evaluation shipped = evaluation();
    EXPECT_GE(shipped.known.auc, 0.939);
    EXPECT_LE(shipped.known.mse, 0.0375);
    EXPECT_GE(shipped.all.auc, 0.88);
    EXPECT_LE(shipped.all.mse, 0.078);
    for (auto& scan : scans)
        for (Ray& r : scan) r.origin[2] += 0.3;  // the sensor's height as it is named is wrong
    const Evaluation corrected = evaluation();
    EXPECT_GE(corrected.known.auc, 0.958);
    EXPECT_LE(corrected.known.mse, 0.037);
    EXPECT_GE(corrected.all.auc, 0.913);
    EXPECT_LE(corrected.all.mse, 0.0722);
}

/** What the default predicts of the next scan, of real and published recordings. */
struct NextScanGate {
    const char *name, *folder, *prefix;
    int scans;
    double raised;                          ///< [m] LA3DM's sensor origins are too low
    double near1, near3, early_and_missed;  ///< shares of the rays
};

void PrintTo(const NextScanGate& gate, std::ostream* out) {
    *out << gate.name;
}

class NextScan : public testing::TestWithParam<NextScanGate> {};

TEST_P(NextScan, OfARecordingIsPredictedAsWellAsEver) {
    const NextScanGate gate = GetParam();
    const char* data = std::getenv("AKIMAP_DATA");
    const std::string folder = std::string(data ? data : "") + gate.folder;
    if (!data || !std::filesystem::exists(folder)) GTEST_SKIP() << "no " << gate.folder;
    Scans scans;
    for (int i = 1; i <= gate.scans; i++) {
        scans.push_back(readPcd(folder + gate.prefix + std::to_string(i) + ".pcd"));
        for (Ray& r : scans.back()) r.origin[2] += gate.raised;
    }
    const AkiMap configured(0.05);
    const auto result = holdContest(recordingOf(scans), {akimapEntrant("AkiMap", "", configured)},
                                    rulesFor(configured));
    const RayShares shares = result.maps.front().rays.shares();
    EXPECT_GE(shares.near1, gate.near1);
    EXPECT_GE(shares.near3, gate.near3);
    EXPECT_LE(shares.early + shares.miss, gate.early_and_missed);
}

INSTANTIATE_TEST_SUITE_P(
    Recordings, NextScan,
    testing::Values(NextScanGate{"corridor", "/corridor/", "corridor_", 16, 0, 0.74, 0.88, 0.118},
                    NextScanGate{"long_term", "/la3dm/sim_structured_long_term/",
                                 "sim_structured_long_term_", 60, 0.3, 0.714, 0.919, 0.081}));
