// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
// Accuracy and mapping time on one scene, in one run.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>

#include "report/accuracy.h"
#include "report/markdown.h"

using namespace akimap;
using namespace akimap::bench;
using akimap::app::SceneKind;

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

/** None if it is not there. */
std::vector<Scene> recordingsOf(const std::string& name, int count, double resolution) {
    std::vector<Scene> scenes;
    if (name == "la3dm") {
        if (Scene scene = la3dmStructured(); !scene.scans.empty()) scenes.push_back(scene);
        return scenes;
    }
    for (uint64_t seed = 1; seed <= static_cast<uint64_t>(count); seed++)
        scenes.push_back(name == "lidar" ? simulatedRings(seed, resolution)
                         : name == "structured"
                             ? simulated(SceneKind::structured, seed, resolution)
                             : simulated(SceneKind::unstructured, seed, resolution));
    return scenes;
}

std::vector<Method> methodsToRun(bool others, bool with_choices,
                                 const std::vector<std::string>& only) {
    std::vector<Method> methods = akimapMethods(), more = otherMethods();
    if (!others && only.empty()) more.resize(1);  // COctoMap
    methods.insert(methods.end(), more.begin(), more.end());
    for (Method& m : with_choices ? choices() : std::vector<Method>()) methods.push_back(m);
    if (only.empty()) return methods;
    std::vector<Method> named;
    for (const std::string& name : only) {
        const auto m = std::find_if(methods.begin(), methods.end(),
                                    [&](const Method& method) { return method.name == name; });
        if (m == methods.end()) throw std::runtime_error("--method: there is no '" + name + "'");
        named.push_back(*m);
    }
    return named;
}

/** For scripts: the figures in the order of accuracyColumns(). */
void printPlain(const std::vector<Row>& rows) {
    for (const Row& r : rows) {
        std::printf("%s", r.name.c_str());
        for (const double v : r.means) std::printf("\t%s", fixed(v, 4).c_str());
        std::printf("\n");
    }
}

}  // namespace

int main(int argc, char** argv) try {
    CLI::App app("Accuracy of AkiMap's modes and MRPT's COctoMap against a scene's truth.");
    std::string name = "structured";
    int seeds = 3;
    unsigned threads = 0;
    double resolution = 0.05;
    bool with_choices = false, with_others = false, plain = false;
    std::vector<std::string> only;
    app.add_option("scene", name, "structured | unstructured | lidar (simulated) | la3dm")
        ->capture_default_str()
        ->check(CLI::IsMember({"structured", "unstructured", "lidar", "la3dm"}));
    app.add_option("--seeds", seeds,
                   "Recordings of a simulated scene to average; la3dm: runs of random methods")
        ->capture_default_str()
        ->check(CLI::PositiveNumber);
    app.add_option("--threads", threads, "Threads of AkiMap; 0: all cores")->capture_default_str();
    app.add_option("--resolution", resolution, "Side of a cell [m]; la3dm: 0.05")
        ->capture_default_str();
    app.add_flag("--others", with_others, "Also other maps of MRPT's and of the literature");
    app.add_flag("--choices", with_choices, "Also the choices that the paper leaves open");
    app.add_option("--method", only, "Only this row; may be given several times");
    app.add_flag(
        "--plain", plain,
        "For scripts: a line for each row, tabs between, 4 decimals: name, known AUC, MSE, "
        "precision and recall of occupied and of free, all AUC, MSE, coverage");
    CLI11_PARSE(app, argc, argv);

    const std::vector<Method> methods = methodsToRun(with_others, with_choices, only);
    const std::vector<Recording> recordings = prepareAll(recordingsOf(name, seeds, resolution));
    if (recordings.empty())
        return std::fprintf(plain ? stderr : stdout,
                            "LA3DM's scene is not in $AKIMAP_DATA: skipped\n"),
               0;
    std::vector<Row> rows;
    for (const Method& m : methods) {
        const Outcome outcome = judgeMethod(m, recordings, seeds, threads);
        rows.push_back(outcome.row);
        rows.back().more = {fixed(outcome.seconds, 3)};
    }
    if (plain) return printPlain(rows), 0;
    std::vector<std::pair<std::string, std::string>> unused;
    const Scene& scene = recordings.front().scene;
    std::printf("%s, %zu scans, %g m cells\n%s", scene.name.c_str(), scene.scans.size(),
                scene.truth.resolution,
                tableOf(rows, accuracyColumns(), {"time [s]"}, "", unused).c_str());
    return 0;
} catch (const std::exception& e) {
    std::fprintf(stderr, "bench_accuracy: %s\n", e.what());
    return 1;
}
