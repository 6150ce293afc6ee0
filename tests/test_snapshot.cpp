// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <akimap/AkiMap.h>
#include <gtest/gtest.h>

#include <atomic>
#include <map>
#include <thread>

#include "random_scans.h"
#include "same_map.h"

using namespace akimap;

namespace {

std::vector<Ray> scan(std::size_t i) {
    return test::randomScan(static_cast<unsigned>(i) + 1, 150);
}

float distanceFrom(const AkiMap& map) {
    mrpt::math::TPoint3Df nearest;
    float distance = 0;
    uint64_t index = 0;
    EXPECT_TRUE(map.nn_single_search({0.5f, 0.5f, 0.5f}, nearest, distance, index));
    return distance;
}

}  // namespace

TEST(Snapshot, IsTheMapAndStaysAsItIs) {
    AkiMap map(0.1);
    map.insertRays(scan(0));
    const auto snapshot = map.snapshot();
    const std::string before = test::fingerprint(map);
    EXPECT_EQ(test::fingerprint(*snapshot), before);
    map.insertRays(scan(1));
    EXPECT_EQ(test::fingerprint(*snapshot), before);
    EXPECT_EQ(test::fingerprint(*map.snapshot()), test::fingerprint(map));
    map.clear();
    EXPECT_EQ(test::fingerprint(*snapshot), before);
    EXPECT_TRUE(map.snapshot()->isEmpty());
}

TEST(Snapshot, IsTheSameUntilTheMapOrAnOptionChanges) {
    AkiMap map(0.1);
    map.insertRays(scan(0));
    const auto first = map.snapshot();
    EXPECT_EQ(map.snapshot(), first);
    map.likelihoodOptions.sigma_hit = 0.2;
    EXPECT_EQ(map.snapshot()->likelihoodOptions.sigma_hit, 0.2);
    map.genericMapParams.enableObservationLikelihood = false;
    EXPECT_FALSE(map.snapshot()->genericMapParams.enableObservationLikelihood);
    const auto second = map.snapshot();
    map.insertRays(scan(1));
    EXPECT_NE(map.snapshot(), second);
    EXPECT_EQ(first->likelihoodOptions.sigma_hit, 0.1);
}

TEST(Snapshot, ReadersNeverSeeHalfAScan) {
    constexpr std::size_t kScans = 40;
    std::map<std::string, std::size_t> scans_in;  // of each state that the map is ever in
    AkiMap rehearsal(0.1);
    for (std::size_t i = 0; i <= kScans; i++) {
        scans_in[test::fingerprint(rehearsal)] = i;
        if (i < kScans) rehearsal.insertRays(scan(i));
    }
    ASSERT_EQ(scans_in.size(), kScans + 1);

    AkiMap map(0.1);
    std::atomic<bool> is_done{false};
    std::atomic<std::size_t> states{0};
    const auto readAll = [&] {
        std::size_t last = 0;
        while (!is_done) {
            const auto snapshot = map.snapshot();
            const auto found = scans_in.find(test::fingerprint(*snapshot));
            ASSERT_NE(found, scans_in.end());
            ASSERT_GE(found->second, last);
            if (found->second > last) states++, distanceFrom(*snapshot);
            last = found->second;
        }
    };
    std::vector<std::thread> readers;
    for (int i = 0; i < 3; i++) readers.emplace_back(readAll);
    for (std::size_t i = 0; i < kScans; i++) {
        map.insertRays(scan(i));
        std::this_thread::sleep_for(std::chrono::milliseconds(5));  // as between two scans
    }
    is_done = true;
    for (auto& reader : readers) reader.join();
    EXPECT_GT(states, kScans / 4);
    EXPECT_EQ(test::fingerprint(map), test::fingerprint(rehearsal));
}
