// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <gtest/gtest.h>

#include <random>

#include "estimators/paper/scale.h"
#include "reference.h"

using namespace akimap;

namespace {
struct RandomProblem {
    ScaleProblem fast;
    std::vector<double> positive, negative;
    RandomProblem(unsigned seed, int n_positive, int n_negative) {
        std::mt19937 random(seed);
        std::uniform_real_distribution<float> u(0, 1);
        const auto add = [&](std::vector<double>& list, bool is_positive) {
            const float v = u(random);
            fast.add(v, is_positive);
            list.push_back(std::sqrt(static_cast<double>(v)));
        };
        for (int i = 0; i < n_positive; i++) add(positive, true);
        for (int i = 0; i < n_negative; i++) add(negative, false);
    }
};
}  // namespace

TEST(Scale, ObjectiveIsEq7) {
    for (unsigned seed = 0; seed < 50; seed++) {
        const RandomProblem p(seed, static_cast<int>(seed % 13), 1 + static_cast<int>(seed % 7));
        for (const double s : {0.1, 0.37, 0.8, 1.0, 1.7}) {
            const double expected = reference::objective(p.positive, p.negative, s);
            EXPECT_NEAR(p.fast.objective(s), expected, 1e-6 * expected + 1e-9);
        }
    }
}

TEST(Scale, MinimumIsTheLowestOfAFineScan) {
    for (unsigned seed = 0; seed < 300; seed++) {
        const RandomProblem p(seed, static_cast<int>(seed % 40), 1 + static_cast<int>(seed % 5));
        const double low = 0.05 + 0.01 * (seed % 30), high = seed % 4 ? 1.0 : 1.5;
        const double s = p.fast.minimise(low, high);
        EXPECT_GE(s, low);
        EXPECT_LE(s, high);
        double lowest = INFINITY;
        for (int i = 0; i <= 5000; i++)
            lowest = std::min(lowest, p.fast.objective(low + (high - low) * i / 5000));
        EXPECT_LE(p.fast.objective(s), lowest * (1 + 1e-6)) << "seed " << seed << " s " << s;
    }
}

TEST(Scale, NegativesPushAndPositivesHold) {
    ScaleProblem one_negative;
    one_negative.add(0.49f, false);
    EXPECT_LE(one_negative.minimise(0.1, 1), 0.7f + 1e-4);  // the support ends before r = 0.7

    ScaleProblem held = one_negative;
    for (int i = 0; i < 200; i++) held.add(0.36f, true);
    EXPECT_GT(held.minimise(0.1, 1), one_negative.minimise(0.1, 1));

    ScaleProblem only_positives;
    for (int i = 0; i < 5; i++) only_positives.add(0.1f * static_cast<float>(i), true);
    EXPECT_NEAR(only_positives.minimise(0.1, 1), 1, 1e-4);
}

TEST(Scale, DescentStaysWithinItsBounds) {
    for (unsigned seed = 0; seed < 50; seed++) {
        const RandomProblem p(seed, 10, 3);
        const double s = p.fast.descend(5000, 0.2);
        EXPECT_GE(s, 0.2);
        EXPECT_LE(s, 1.0);
    }
}

TEST(Scale, TheDescentsGradientIsThatOfEq7) {
    // Where every neighbour lies inside the support: beyond it the authors' formula is none.
    for (unsigned seed = 0; seed < 30; seed++) {
        const RandomProblem p(seed, 10, 3);
        constexpr double s = 1.2, h = 1e-5, weight = 700;
        const double expected =
            weight / 2 * (p.fast.objective(s + h) - p.fast.objective(s - h)) / (2 * h);
        EXPECT_NEAR(p.fast.gradient(weight, s), expected, 1e-4 * std::abs(expected) + 1e-3);
    }
}
