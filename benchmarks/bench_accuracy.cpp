// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
// Accuracy and mapping time on one scene, in one run.

#include <CLI/CLI.hpp>
#include <cstdio>

#include "report/accuracy.h"
#include "report/markdown.h"

using namespace akimap;
using namespace akimap::bench;

namespace {

/** The choices that the paper leaves open. */
std::vector<Method> choices() {
    const auto choice = [](const char* name, const std::function<void(InsertionParameters&)>& set) {
        return akimapMethod(name, name, [set](auto& o) { o.estimator = Estimator::paper, set(o); });
    };
    return {
        choice("Eq. 7 by descent", [](auto& o) { o.scale_search = ScaleSearch::descent; }),
        choice("scale up to 1.7", [](auto& o) { o.scale_max = 1.7; }),
        choice("ball search", [](auto& o) { o.search_region = SearchRegion::ball; }),
        choice("about the mean", [](auto& o) { o.covariance_center = CovarianceCenter::mean; }),
        choice("floor 5e-4 m^2", [](auto& o) { o.covariance_floor = 5e-4; }),
        choice("floor 2e-3 m^2", [](auto& o) { o.covariance_floor = 2e-3; }),
        choice("search 0.3 m throughout",
               [](auto& o) { o.search_range_origin = o.search_range_max = 0.3; }),
        choice("search 0.5 m throughout",
               [](auto& o) { o.search_range_origin = o.search_range_max = 0.5; }),
    };
}

Scene sceneOf(const std::string& name, double resolution) {
    if (name == "la3dm") return la3dmStructured();
    const bool is_structured = name == "structured";
    return simulated(is_structured ? app::SceneKind::structured : app::SceneKind::unstructured, 1,
                     resolution);
}

}  // namespace

int main(int argc, char** argv) try {
    CLI::App app("Accuracy of AkiMap's modes and MRPT's COctoMap against a scene's truth.");
    std::string name = "structured";
    int seeds = 3;
    unsigned threads = 0;
    double resolution = 0.05;
    bool with_choices = false, with_others = false;
    app.add_option("scene", name, "structured | unstructured (simulated) | la3dm")
        ->capture_default_str()
        ->check(CLI::IsMember({"structured", "unstructured", "la3dm"}));
    app.add_option("--seeds", seeds, "Runs to average")
        ->capture_default_str()
        ->check(CLI::PositiveNumber);
    app.add_option("--threads", threads, "Threads of AkiMap; 0: all cores")->capture_default_str();
    app.add_option("--resolution", resolution, "Side of a cell [m]; la3dm: 0.05")
        ->capture_default_str();
    app.add_flag("--others", with_others, "Also other maps of MRPT's and of the literature");
    app.add_flag("--choices", with_choices, "Also the choices that the paper leaves open");
    CLI11_PARSE(app, argc, argv);

    const Scene scene = sceneOf(name, resolution);
    if (scene.scans.empty())
        return std::printf("LA3DM's scene is not in $AKIMAP_DATA: skipped\n"), 0;
    std::vector<Method> methods = akimapMethods(), others = otherMethods();
    if (!with_others) others.resize(1);  // COctoMap
    methods.insert(methods.end(), others.begin(), others.end());
    for (Method& m : with_choices ? choices() : std::vector<Method>()) methods.push_back(m);

    const std::vector<PreparedScan> scans = prepare(scene.scans, kMaxRange);
    std::vector<Row> rows;
    for (const Method& m : methods) {
        const Outcome outcome = judgeMethod(m, scene, scans, seeds, threads);
        rows.push_back(outcome.row);
        rows.back().more = {fixed(outcome.seconds, 3)};
    }
    std::vector<std::pair<std::string, std::string>> unused;
    std::printf("%s, %zu scans, %g m cells, mean of %d seeds\n%s", scene.name.c_str(),
                scene.scans.size(), scene.truth.resolution, seeds,
                tableOf(rows, accuracyColumns(), {"time [s]"}, "", unused).c_str());
    return 0;
} catch (const std::exception& e) {
    std::fprintf(stderr, "bench_accuracy: %s\n", e.what());
    return 1;
}
