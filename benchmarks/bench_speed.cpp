// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
// Insertion time of AkiMap and of BGKOctoMap beside MRPT's COctoMap, alternating in one process:
// quote the ratios.

#include <mrpt/maps/COctoMap.h>

#include <cstdio>
#include <random>

#include "grid/BlockGrid.h"
#include "mapping/RealtimeGate.h"
#include "rivals/BgkLOctoMap.h"
#include "rivals/BgkOctoMap.h"
#include "scenes.h"
#include "timing.h"

using namespace akimap;
using bench::median;
using bench::seconds;

namespace {

constexpr int kPairs = 7;
constexpr double kMaxRange = 8;

struct Times {
    double seconds;
    InsertionStats stats;
    double bytes_per_cell;
};

Times insertIntoAkiMap(const std::vector<bench::PointCloudScan>& scans, unsigned threads) {
    AkiMap map;
    map.insertionOptions.threads = threads, map.insertionOptions.max_range = kMaxRange;
    const double time = seconds([&] {
        for (const auto& s : scans) map.insertObservation(s.observation, s.robot);
    });
    return {time, map.stats(),
            static_cast<double>(map.memoryBytes()) / static_cast<double>(map.cellCount())};
}

double insertIntoOctoMap(const std::vector<bench::PointCloudScan>& scans) {
    mrpt::maps::COctoMap map(0.05);
    return seconds([&] {
        for (const auto& s : scans) map.insertObservation(s.observation, s.robot);
    });
}

template <class Map>
double insertInto(Map map, const bench::Scene& scene) {
    return seconds([&] {
        for (const auto& scan : scene.scans) map.insert(scan);
    });
}

void compare(const bench::Scene& scene) {
    if (scene.scans.empty())
        return void(std::printf("%s: not in $AKIMAP_DATA, skipped\n", scene.name.c_str()));
    const bench::Scene near = scene.within(kMaxRange);
    std::vector<bench::PointCloudScan> scans;
    for (const auto& scan : near.scans) scans.push_back(bench::asPointCloud(scan));
    std::vector<double> octomap, one, two, ratio, speedup, bgk, bgkl;
    Times last{};
    insertIntoAkiMap(scans, 1);  // warm up
    for (int i = 0; i < kPairs; i++) {
        octomap.push_back(insertIntoOctoMap(scans));
        last = insertIntoAkiMap(scans, 1);
        one.push_back(last.seconds);
        two.push_back(insertIntoAkiMap(scans, 2).seconds);
        ratio.push_back(one.back() / octomap.back());
        speedup.push_back(one.back() / two.back());
        bgk.push_back(insertInto(bench::BgkOctoMap(), near) / octomap.back());
        bgkl.push_back(insertInto(bench::BgkLOctoMap(), near) / octomap.back());
    }
    const auto& s = last.stats;
    std::printf("%s, %zu scans within %g m, medians of %d rounds\n", scene.name.c_str(),
                scans.size(), kMaxRange, kPairs);
    std::printf("  MRPT COctoMap      %.3f s\n", median(octomap));
    std::printf(
        "  AkiMap, 1 thread   %.3f s   %.2f x COctoMap's time  (sampling %.3f, bandwidth %.3f, "
        "update %.3f)\n",
        median(one), median(ratio), s.seconds_sampling, s.seconds_bandwidth, s.seconds_update);
    std::printf("  AkiMap, 2 threads  %.3f s   %.2f times as fast as 1\n", median(two),
                median(speedup));
    std::printf("  BGKOctoMap, 1 thread                %.2f x COctoMap's time\n", median(bgk));
    std::printf("  BGKOctoMap-L (0.3 m), 1 thread      %.2f x COctoMap's time\n", median(bgkl));
    std::printf("  map memory         %.1f bytes a cell with evidence\n", last.bytes_per_cell);
}

/** Random point queries of one thread, and visits of all cells, in a map of the scene. */
void query(const bench::Scene& scene) {
    AkiMap map;
    for (const auto& scan : scene.scans) map.insertRays(scan);
    constexpr std::size_t kQueries = 2000000;
    std::mt19937 random(1);
    std::uniform_real_distribution<double> u(0, 1);
    std::vector<mrpt::math::TPoint3D> points;
    for (std::size_t i = 0; i < kQueries; i++)
        points.emplace_back(7 * u(random), 10 * u(random), 2 * u(random));
    double sum = 0;
    const double queries = seconds([&] {
        for (const auto& p : points)
            if (const auto cell = map.cell(p.x, p.y, p.z)) sum += cell->occupancy();
    });
    constexpr int kVisits = 10;
    std::size_t cells = 0;
    const double visits = seconds([&] {
        for (int i = 0; i < kVisits; i++)
            map.grid().forEachCell([&](const CellIndex&, float alpha, float) {
                sum += static_cast<double>(alpha), cells++;
            });
    });
    std::printf("queries in a map of %zu cells (sum %.3g)\n", map.cellCount(), sum);
    std::printf("  random points      %.1f million a second and thread\n",
                kQueries / queries / 1e6);
    std::printf("  visiting cells     %.0f million a second\n",
                static_cast<double>(cells) / visits / 1e6);
}

/** Inserts a drive as it comes. \return the times [s] of the updates */
std::vector<double> updates(AkiMap& map, const bench::LidarDrive& drive, std::size_t first,
                            app::RealtimeGate& gate) {
    map.insertionOptions.threads = 2, map.insertionOptions.max_range = 10;
    std::vector<double> times;
    for (std::size_t i = first; i < drive.scans.size(); i++) {
        if (!gate.offer(static_cast<double>(i) / drive.rate)) continue;
        times.push_back(seconds([&] { map.insertRays(drive.scans[i]); }));
        gate.used(times.back());
    }
    return times;
}

/** A spinning lidar at 10 m range on two threads: whether it keeps up, and whether the late scans
 * cost more than in a map that holds nothing else. */
void drive(const bench::LidarModel& model) {
    constexpr std::size_t kScans = 40, kLast = 10;
    const bench::LidarDrive lidar = bench::simulatedLidar(kScans, model);
    AkiMap map, empty;
    app::RealtimeGate gate, again;
    const auto all = updates(map, lidar, 0, gate);
    const auto last = updates(empty, lidar, kScans - kLast, again);
    const std::size_t n = std::min(last.size(), all.size());
    const double late = median({all.end() - static_cast<std::ptrdiff_t>(n), all.end()});
    std::printf("%s, %zu scans of %zu points, within 10 m, 2 threads\n", lidar.name.c_str(), kScans,
                lidar.scans.front().size());
    std::printf("  update             %.1f ms (median), %llu scans lost at %g Hz\n",
                1e3 * median(all), static_cast<unsigned long long>(gate.lost()), lidar.rate);
    std::printf("  the last %zu scans  %.2f x what they take in an empty map\n", kLast,
                late / median(last));
    std::printf("  map memory         %.1f bytes a cell with evidence\n",
                static_cast<double>(map.memoryBytes()) / static_cast<double>(map.cellCount()));
}

}  // namespace

int main() try {
    compare(bench::la3dmStructured());
    compare(bench::simulated(app::SceneKind::structured, 1, 0.05));
    query(bench::simulated(app::SceneKind::structured, 1, 0.05));
    drive(bench::sixteenBeams());
    drive(bench::denseLidar());
    return 0;
} catch (const std::exception& e) {
    std::fprintf(stderr, "bench_speed: %s\n", e.what());
    return 1;
}
