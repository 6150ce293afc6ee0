// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <set>

#include "numeric/NeighborRows.h"

using akimap::Bounds;
using akimap::NeighborRows;
using akimap::PointList;

namespace {

constexpr double kGrain = 0.05;
using Point = std::array<float, 3>;

struct Cloud {
    std::vector<float> x, y, z;
    Cloud(unsigned seed, std::size_t n, float spread) {
        std::mt19937 random(seed);
        std::uniform_real_distribution<float> u(-spread, spread);
        for (std::size_t i = 0; i < n; i++) add(u(random), u(random), 0.1f * u(random));
    }
    void add(float px, float py, float pz) { x.push_back(px), y.push_back(py), z.push_back(pz); }
    [[nodiscard]] NeighborRows rows() const {
        NeighborRows r;
        r.build(x.data(), y.data(), z.data(), x.size(), kGrain);
        return r;
    }
    [[nodiscard]] Bounds around(std::size_t i, float reach) const {
        return {{x[i] - reach, y[i] - reach, z[i] - reach},
                {x[i] + reach, y[i] + reach, z[i] + reach}};
    }
    [[nodiscard]] bool isIn(const Bounds& b, std::size_t i) const {
        const float p[3] = {x[i], y[i], z[i]};
        return std::equal(p, p + 3, b.low, std::greater_equal<>()) &&
               std::equal(p, p + 3, b.high, std::less_equal<>());
    }
};

}  // namespace

TEST(NeighborRows, FindEveryPointOfABoxOnceAndNoOther) {
    for (const float spread : {0.01f, 1.0f, 20.0f, 5000.0f}) {
        for (const std::size_t n :
             {std::size_t{1}, std::size_t{8}, std::size_t{9}, std::size_t{63}, std::size_t{2001}}) {
            const Cloud c(7, n, spread);
            const NeighborRows rows = c.rows();
            ASSERT_EQ(rows.size(), n);
            PointList found;
            for (std::size_t i = 0; i < n; i += 37) {
                const Bounds box = c.around(i, 0.05f + 0.5f * static_cast<float>(i % 10) / 10);
                rows.findPoints(box, found);
                std::multiset<Point> seen, expected;
                for (std::size_t k = 0; k < found.count; k++)
                    seen.insert({found.x[k], found.y[k], found.z[k]});
                for (std::size_t j = 0; j < n; j++)
                    if (c.isIn(box, j)) expected.insert({c.x[j], c.y[j], c.z[j]});
                EXPECT_EQ(seen, expected);
            }
        }
    }
}

TEST(NeighborRows, Empty) {
    const NeighborRows rows = Cloud(1, 0, 1).rows();
    PointList found;
    found.count = 3;
    rows.findPoints({{-1, -1, -1}, {1, 1, 1}}, found);
    EXPECT_EQ(found.count, 0u);
    EXPECT_EQ(rows.rows(), 0u);
}

TEST(NeighborRows, AFarOutlierChangesNothingForTheOthers) {
    Cloud c(3, 4000, 2);
    const auto pointsMet = [&] {
        const NeighborRows rows = c.rows();
        PointList found;
        std::size_t n = 0;
        for (std::size_t row = 0; row < rows.rows(); row++) {
            Bounds b = rows.boundsOf(row);
            for (int a = 0; a < 3; a++) b.low[a] -= 0.2f, b.high[a] += 0.2f;
            rows.findPoints(b, found);
            n += found.count;
        }
        return n;
    };
    const std::size_t without = pointsMet();
    c.add(10000, -10000, 3000);
    EXPECT_LT(pointsMet(), without + 8000);  // the row that holds it meets all, twice at most
}
