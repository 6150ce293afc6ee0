// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
// Accuracy and mapping time of AkiMap's modes and of MRPT's COctoMap on one scene, in one run.

#include <mrpt/maps/COctoMap.h>
#include <mrpt/system/CTicTac.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <functional>

#include "evaluation/evaluate.h"
#include "rivals/BgkLOctoMap.h"
#include "rivals/BgkOctoMap.h"
#include "rivals/GmmMap.h"
#include "scenes.h"

using namespace akimap;

namespace {

struct Row {
    std::string name;
    app::Evaluation evaluation;
    double seconds;
};

void print(const Row& r) {
    const auto& k = r.evaluation.known;
    const auto& a = r.evaluation.all;
    std::printf("%-24s %6.3f %6.3f  %5.3f %5.3f  %5.3f %5.3f  %6.3f %6.3f  %5.3f %8.3f\n",
                r.name.c_str(), k.auc, k.mse, k.occupied.precision, k.occupied.recall,
                k.free.precision, k.free.recall, a.auc, a.mse, r.evaluation.coverage, r.seconds);
}

/** The mean of the figures over seeds. */
Row mean(std::vector<Row> rows) {
    Row m = rows.front();
    const double n = static_cast<double>(rows.size());
    const auto average = [&](auto&& field) {
        double sum = 0;
        for (Row& r : rows) sum += field(r);
        field(m) = sum / n;
    };
    for (const auto scores : {&app::Evaluation::known, &app::Evaluation::all}) {
        average([&](Row& r) -> double& { return (r.evaluation.*scores).auc; });
        average([&](Row& r) -> double& { return (r.evaluation.*scores).mse; });
        average([&](Row& r) -> double& { return (r.evaluation.*scores).log_loss; });
        average([&](Row& r) -> double& { return (r.evaluation.*scores).calibration_error; });
        average([&](Row& r) -> double& { return (r.evaluation.*scores).occupied.precision; });
        average([&](Row& r) -> double& { return (r.evaluation.*scores).occupied.recall; });
        average([&](Row& r) -> double& { return (r.evaluation.*scores).free.precision; });
        average([&](Row& r) -> double& { return (r.evaluation.*scores).free.recall; });
    }
    average([](Row& r) -> double& { return r.evaluation.coverage; });
    average([](Row& r) -> double& { return r.seconds; });
    return m;
}

Row akimapRow(const std::string& name, const bench::Scene& scene, int seeds, unsigned threads,
              const std::function<void(InsertionParameters&)>& set) {
    std::vector<Row> rows;
    for (int seed = 1; seed <= seeds; seed++) {
        AkiMap map(scene.truth.resolution);
        map.insertionOptions.seed = static_cast<uint64_t>(seed),
        map.insertionOptions.threads = threads;
        set(map.insertionOptions);
        mrpt::system::CTicTac clock;
        for (const auto& scan : scene.scans) map.insertRays(scan);
        const double seconds = clock.Tac();
        rows.push_back({name, app::evaluate(map, scene.truth, scene.box), seconds});
    }
    return mean(rows);
}

Row octomapRow(const bench::Scene& scene) {
    std::vector<bench::PointCloudScan> scans;
    for (const auto& scan : scene.within(InsertionParameters().max_range).scans)
        scans.push_back(bench::asPointCloud(scan));
    mrpt::maps::COctoMap map(scene.truth.resolution);
    mrpt::system::CTicTac clock;
    for (const auto& s : scans) map.insertObservation(s.observation, s.robot);
    const double seconds = clock.Tac();
    return {"MRPT COctoMap", app::evaluate(map, scene.truth, scene.box), seconds};
}

Row rivalRow(const std::string& name, const bench::Scene& scene, bench::Rival& map) {
    mrpt::system::CTicTac clock;
    for (const auto& scan : scene.scans) map.insert(scan);
    const double seconds = clock.Tac();
    const auto lookup = [&](double x, double y, double z) { return map.occupancy(x, y, z); };
    return {name, app::evaluate(lookup, scene.truth.resolution, scene.truth, scene.box), seconds};
}

/** Other methods, on one thread. */
void printRivals(const bench::Scene& scene, int seeds) {
    bench::BgkOptions points, lines = bench::BgkLOctoMap::defaults();
    points.resolution = lines.resolution = scene.truth.resolution;
    bench::BgkOctoMap bgk(points);
    print(rivalRow("BGKOctoMap", scene, bgk));
    bench::BgkLOctoMap bgkl(lines);
    print(rivalRow("BGKOctoMap-L, 0.3 m", scene, bgkl));
    lines.free_step = 0.5;
    bench::BgkLOctoMap coarse(lines);
    print(rivalRow("BGKOctoMap-L, 0.5 m", scene, coarse));
    std::vector<Row> rows;
    double fitting = 0;
    for (int seed = 1; seed <= seeds; seed++) {
        bench::GmmOptions o;
        o.resolution = scene.truth.resolution, o.seed = static_cast<uint64_t>(seed);
        bench::GmmMap map(o);
        rows.push_back(rivalRow("GMM-OM, 70 components", scene, map));
        fitting += map.secondsFitting() / seeds;
    }
    print(mean(rows));
    std::printf("%-24s of the time, %.3f s for fitting\n", "", fitting);
}

}  // namespace

int main(int argc, char** argv) try {
    CLI::App app("Accuracy of AkiMap's modes and MRPT's COctoMap against a scene's truth.");
    std::string name = "structured";
    int seeds = 3;
    unsigned threads = 0;
    double resolution = 0.05;
    bool choices = false;
    app.add_option("scene", name, "structured | unstructured (simulated) | la3dm")
        ->capture_default_str();
    app.add_option("--seeds", seeds, "Runs to average")
        ->capture_default_str()
        ->check(CLI::PositiveNumber);
    app.add_option("--threads", threads, "Threads of AkiMap; 0: all cores")->capture_default_str();
    app.add_option("--resolution", resolution, "Side of a cell [m]; la3dm: 0.05")
        ->capture_default_str();
    app.add_flag("--choices", choices, "Also the choices that the paper leaves open");
    CLI11_PARSE(app, argc, argv);

    const bench::Scene scene =
        name == "la3dm" ? bench::la3dmStructured()
                        : bench::simulated(name == "unstructured" ? app::SceneKind::unstructured
                                                                  : app::SceneKind::structured,
                                           1, resolution);
    if (scene.scans.empty())
        return std::printf("LA3DM's scene is not in $AKIMAP_DATA: skipped\n"), 0;

    std::printf("%s, %zu scans, %g m cells, mean of %d seeds\n", scene.name.c_str(),
                scene.scans.size(), scene.truth.resolution, seeds);
    std::printf("%-24s %6s %6s  %5s %5s  %5s %5s  %6s %6s  %5s %8s\n", "", "known:", "", "occ.", "",
                "free", "", "all:", "", "cover", "mapping");
    std::printf("%-24s %6s %6s  %5s %5s  %5s %5s  %6s %6s  %5s %8s\n", "", "AUC", "MSE", "prec.",
                "rec.", "prec.", "rec.", "AUC", "MSE", "age", "time [s]");
    const auto row = [&](const char* label, const std::function<void(InsertionParameters&)>& set) {
        print(akimapRow(label, scene, seeds, threads, set));
    };
    row("AkiMap", [](auto&) {});
    const auto paper = [&](const char* label,
                           const std::function<void(InsertionParameters&)>& set) {
        row(label, [&](auto& o) { o.estimator = Estimator::paper, set(o); });
    };
    paper("the paper's", [](auto&) {});
    paper("covariance", [](auto& o) { o.bandwidth = Bandwidth::covariance; });
    paper("isotropic", [](auto& o) { o.bandwidth = Bandwidth::isotropic; });
    print(octomapRow(scene));
    printRivals(scene, seeds);
    if (!choices) return 0;
    paper("Eq. 7 by descent", [](auto& o) { o.scale_search = ScaleSearch::descent; });
    paper("scale up to 1.7", [](auto& o) { o.scale_max = 1.7; });
    paper("ball search", [](auto& o) { o.search_region = SearchRegion::ball; });
    paper("about the mean", [](auto& o) { o.covariance_center = CovarianceCenter::mean; });
    paper("floor 5e-4 m^2", [](auto& o) { o.covariance_floor = 5e-4; });
    paper("floor 2e-3 m^2", [](auto& o) { o.covariance_floor = 2e-3; });
    paper("search 0.3 m throughout",
          [](auto& o) { o.search_range_origin = o.search_range_max = 0.3; });
    paper("search 0.5 m throughout",
          [](auto& o) { o.search_range_origin = o.search_range_max = 0.5; });
    return 0;
} catch (const std::exception& e) {
    std::fprintf(stderr, "bench_accuracy: %s\n", e.what());
    return 1;
}
