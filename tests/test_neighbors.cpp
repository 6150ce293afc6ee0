// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

#include "NeighborGrid.h"

using akimap::NeighborGrid;

namespace {
struct Cloud {
    std::vector<float> x, y, z;
    Cloud(unsigned seed, std::size_t n, float spread) {
        std::mt19937 random(seed);
        std::uniform_real_distribution<float> u(-spread, spread);
        for (std::size_t i = 0; i < n; i++)
            x.push_back(u(random)), y.push_back(u(random)), z.push_back(0.1f * u(random));
    }
};
}  // namespace

TEST(NeighborGrid, RunsHoldEveryPointOfTheBoxOnce) {
    for (const float spread : {0.01f, 1.0f, 20.0f, 5000.0f}) {
        const Cloud c(7, 2000, spread);
        NeighborGrid grid;
        grid.build(c.x.data(), c.y.data(), c.z.data(), c.x.size(), 0.25f);
        ASSERT_EQ(grid.size(), c.x.size());
        for (std::size_t i = 0; i < c.x.size(); i += 37) {
            const float reach = 0.05f + 0.5f * static_cast<float>(i % 10) / 10;
            std::set<uint32_t> seen;
            grid.forEachRun(c.x[i], c.y[i], c.z[i], reach, [&](uint32_t begin, uint32_t end) {
                for (uint32_t p = begin; p < end; p++) {
                    EXPECT_TRUE(seen.insert(grid.order()[p]).second);
                    EXPECT_EQ(grid.x()[p], c.x[grid.order()[p]]);
                    EXPECT_EQ(grid.z()[p], c.z[grid.order()[p]]);
                }
            });
            for (uint32_t j = 0; j < c.x.size(); j++) {
                const float far = std::max({std::abs(c.x[j] - c.x[i]), std::abs(c.y[j] - c.y[i]),
                                            std::abs(c.z[j] - c.z[i])});
                if (far <= reach) {
                    EXPECT_TRUE(seen.count(j)) << "spread " << spread << ", at distance " << far;
                }
            }
        }
    }
}

TEST(NeighborGrid, EmptyAndSinglePoint) {
    NeighborGrid grid;
    int runs = 0;
    const auto count = [&](uint32_t, uint32_t) { runs++; };
    grid.build(nullptr, nullptr, nullptr, 0, 0.25f);
    grid.forEachRun(0, 0, 0, 1, count);
    EXPECT_EQ(runs, 0);
    const float p[] = {3};
    grid.build(p, p, p, 1, 0.25f);
    grid.forEachRun(3, 3, 3, 0.1f, count);
    EXPECT_EQ(runs, 1);
    grid.forEachRun(-50, 3, 3, 0.1f, count);  // far off on either side
    grid.forEachRun(50, 3, 3, 0.1f,
                    [&](uint32_t begin, uint32_t end) { EXPECT_EQ(end - begin, 1u); });
    EXPECT_EQ(runs, 1);
}
