// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
// Each room by itself on one simulated scan, and the whole insertion.

#include <benchmark/benchmark.h>
#include <tbb/task_arena.h>

#include "estimators/paper/PaperEstimator.h"
#include "estimators/paper/free_samples.h"
#include "scenes.h"

using namespace akimap;

namespace {

/** One simulated scan, taken as far as a room needs it. */
struct Prepared {
    InsertionParameters parameters;
    std::vector<Ray> rays;
    BlockGrid grid{0.05};
    PaperWorkspace s;
    InsertionStats stats;

    Prepared() : rays(app::simulatedRays({}).front()) {
        takeSamples(rays, parameters, grid, 0, s.taken, s.samples, stats);
        bandwidths(s.samples, parameters, 0.05, s.neighbors, s.H);
        scatter(s, grid);
    }
};
Prepared& prepared() {
    static Prepared p;
    return p;
}

/** Runs the room in an arena of so many threads. */
template <class Room>
void run(benchmark::State& state, Room&& room) {
    Prepared& p = prepared();
    tbb::task_arena arena(static_cast<int>(state.range(0)));
    for (auto _ : state) arena.execute([&] { room(p); });
    state.counters["samples"] = static_cast<double>(p.s.samples.size());
}

void sampling(benchmark::State& state) {
    run(state, [](Prepared& p) {
        takeSamples(p.rays, p.parameters, p.grid, 0, p.s.taken, p.s.samples, p.stats);
    });
}
void bandwidth(benchmark::State& state) {
    run(state,
        [](Prepared& p) { bandwidths(p.s.samples, p.parameters, 0.05, p.s.neighbors, p.s.H); });
}
void update(benchmark::State& state) {
    run(state, [](Prepared& p) { scatter(p.s, p.grid); });
}
void insertion(benchmark::State& state) {
    AkiMap map;
    map.insertionOptions.threads = static_cast<uint32_t>(state.range(0));
    for (auto _ : state) map.insertRays(prepared().rays);
}

BENCHMARK(sampling)->Arg(1)->Unit(benchmark::kMillisecond);
BENCHMARK(bandwidth)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(update)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(insertion)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace

BENCHMARK_MAIN();
