// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
// A day's work: as many scans as a drive of 8 hours gives at 10 Hz, one after the other.
// SOAK_SCANS: how many (288000).
#include <akimap/AkiMap.h>
#include <gtest/gtest.h>
#include <malloc.h>
#include <time.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <numeric>
#include <random>
#include <thread>

#include "same_map.h"

using namespace akimap;

namespace {

std::size_t scans() {
    const char* const text = std::getenv("SOAK_SCANS");
    return text ? std::strtoull(text, nullptr, 10) : 288000;
}

struct Box {
    std::array<double, 3> low, high;  ///< [m]
};

/** Where a ray leaves the box that it begins in [m]. */
double wayOut(const Box& box, const std::array<double, 3>& from, const std::array<double, 3>& way) {
    double t = 1e9;
    for (std::size_t i = 0; i < 3; i++)
        if (way[i] != 0) t = std::min(t, ((way[i] > 0 ? box.high : box.low)[i] - from[i]) / way[i]);
    return t;
}

/** A scan of a room, with 1 cm of noise. */
std::vector<Ray> scanOf(const Box& room, const std::array<double, 3>& sensor,
                        std::mt19937& random) {
    std::normal_distribution<double> normal;
    std::vector<Ray> rays(60);
    for (Ray& ray : rays) {
        std::array<double, 3> way{normal(random), normal(random), normal(random)};
        const double norm = std::sqrt(std::inner_product(way.begin(), way.end(), way.begin(), 0.0));
        for (double& w : way) w /= norm;
        const double range = wayOut(room, sensor, way) + 0.01 * normal(random);
        ray.origin = sensor;
        for (std::size_t i = 0; i < 3; i++) ray.end[i] = sensor[i] + range * way[i];
    }
    return rays;
}

double allocated() {
    const auto all = mallinfo2();
    return static_cast<double>(all.uordblks + all.hblkhd);
}

/** What this thread has worked [s]: other programs do not count. */
double worked() {
    struct timespec time {};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/** Time and memory of a tenth of the scans. */
struct Tenth {
    double seconds = 0, bytes = 0;  ///< of a scan, of the process at the end
};

template <class Insert>
std::array<Tenth, 10> inTenths(Insert&& insert) {
    std::array<Tenth, 10> tenths;
    const std::size_t n = scans() / 10;
    for (std::size_t t = 0; t < 10; t++) {
        const double start = worked();
        for (std::size_t i = 0; i < n; i++) insert(t * n + i);
        tenths[t].seconds = (worked() - start) / static_cast<double>(n);
        tenths[t].bytes = allocated();
        std::cout << "scan " << (t + 1) * n << ": " << tenths[t].seconds * 1e3 << " ms a scan, "
                  << tenths[t].bytes / 1e6 << " MB\n";
    }
    return tenths;
}

double mostEvidence(const AkiMap& map) {
    double most = 0;
    map.forEachCell([&](const Cell& c) { most = std::max(most, c.state.alpha + c.state.beta); });
    return most;
}

/** The map, through a stream and back. */
void requireRoundTrip(AkiMap& map) {
    mrpt::io::CMemoryStream stream;
    mrpt::serialization::archiveFrom(stream) << map;
    stream.Seek(0);
    AkiMap again;
    mrpt::serialization::archiveFrom(stream) >> again;
    ASSERT_EQ(test::fingerprint(again), test::fingerprint(map));
    again.insertionOptions.threads = map.insertionOptions.threads;
    map = again;
}

}  // namespace

TEST(Soak, ARoomForADayTakesTheSameTimeAndMemoryAllAlong) {
    AkiMap map(0.1);
    map.insertionOptions.threads = 1;
    std::mt19937 random(1);
    const Box room{{0, 0, 0}, {6, 5, 2.5}};
    const auto tenths = inTenths([&](std::size_t i) {
        const double angle = 0.01 * static_cast<double>(i);
        map.insertRays(scanOf(room, {3 + 1.5 * std::cos(angle), 2.5 + std::sin(angle), 1}, random));
        if (i % 20000 == 19999) requireRoundTrip(map);
    });
    EXPECT_LT(tenths[9].seconds, 1.25 * tenths[1].seconds);
    EXPECT_LT(tenths[9].bytes, tenths[1].bytes + 1e6);
    EXPECT_LE(mostEvidence(map), map.insertionOptions.max_evidence * 1.001 + 0.002);

    // The wall at x = 6 m goes 1 m farther: a day's evidence is unlearnt.
    const Box larger{{0, 0, 0}, {7, 5, 2.5}};
    ASSERT_GT(map.occupancy(6.0, 2.55, 1.05).value_or(0), 0.5);
    std::size_t until_free = 0;
    while (map.occupancy(5.95, 2.55, 1.05).value_or(1) > 0.4 ||
           map.occupancy(6.05, 2.55, 1.05).value_or(1) > 0.4) {
        map.insertRays(scanOf(larger, {3, 2.5, 1}, random));
        ASSERT_LT(++until_free, 20000u);
    }
    std::cout << "a wall that has gone is free after " << until_free << " scans of 60 rays\n";
}

TEST(Soak, ACorridorForADayGrowsWithItsLength) {
    AkiMap map(0.1);
    map.insertionOptions.threads = 1;
    std::mt19937 random(2);
    std::vector<std::size_t> blocks;
    const auto tenths = inTenths([&](std::size_t i) {
        const double x = 0.01 * static_cast<double>(i);  // a map of 2.9 km
        const Box around{{x - 6, 0, 0}, {x + 6, 2, 2.5}};
        map.insertRays(scanOf(around, {x, 1, 1}, random));
        if (i % (scans() / 10) == scans() / 10 - 1) blocks.push_back(map.blockCount());
    });
    ASSERT_EQ(blocks.size(), 10u);
    for (std::size_t t = 1; t < 10; t++) {
        const auto tenth = static_cast<double>(blocks[9] - blocks[0]) / 9;
        EXPECT_NEAR(static_cast<double>(blocks[t] - blocks[t - 1]), tenth, 0.1 * tenth);
    }
    EXPECT_LT(tenths[9].seconds, 1.5 * tenths[1].seconds);
    std::cout << map.blockCount() << " blocks, " << static_cast<double>(map.memoryBytes()) / 1e6
              << " MB\n";
}

/** A writer at 10 Hz, and readers that never pause. */
TEST(Soak, AWriterLosesLittleToItsReaders) {
    constexpr std::size_t kScans = 100;
    std::mt19937 random(3);
    const Box room{{0, 0, 0}, {6, 5, 2.5}};
    std::vector<std::vector<Ray>> drive;
    for (std::size_t i = 0; i < kScans; i++) {
        drive.emplace_back();
        for (int part = 0; part < 150; part++)  // 9000 rays a scan
            for (const Ray& ray : scanOf(room, {3, 2 + 0.01 * static_cast<double>(i), 1}, random))
                drive.back().push_back(ray);
    }
    double alone = 0;
    for (std::size_t readers = 0; readers <= 3; readers++) {
        AkiMap map(0.05);
        map.insertionOptions.threads = 1;
        std::atomic<bool> is_done{false};
        std::atomic<std::size_t> questions{0};
        std::vector<std::thread> threads;
        for (std::size_t r = 0; r < readers; r++)
            threads.emplace_back([&, r] {
                std::mt19937 own(static_cast<unsigned>(r));
                std::uniform_real_distribution<double> unit;
                while (!is_done) {
                    const auto snapshot = map.snapshot();
                    for (int i = 0; i < 1000; i++)
                        (void)snapshot->occupancy(6 * unit(own), 5 * unit(own), 2.5 * unit(own));
                    questions += 1000;
                }
            });
        double seconds = 0;
        const auto begin = std::chrono::steady_clock::now();
        for (std::size_t i = 0; i < kScans; i++) {
            const double start = worked();
            map.insertRays(drive[i]);
            seconds += worked() - start;
            std::this_thread::sleep_until(begin + (i + 1) * std::chrono::milliseconds(100));
        }
        is_done = true;
        for (auto& thread : threads) thread.join();
        std::cout << readers << " readers: " << seconds / kScans * 1e3 << " ms a scan, "
                  << static_cast<double>(questions) / (kScans * 0.1) / 1e6
                  << " million questions a second\n";
        if (readers == 0) alone = seconds;
        EXPECT_LT(seconds, 1.1 * alone);
    }
}
