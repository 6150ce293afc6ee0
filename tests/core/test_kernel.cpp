// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <gtest/gtest.h>

#include <cmath>

#include "estimators/kernels/kernel_function.h"

using namespace akimap;

namespace {
constexpr double kPi = 3.14159265358979323846;
double asPrinted(double r) {
    return r < 1 ? (2 + std::cos(2 * kPi * r)) / 3 * (1 - r) + std::sin(2 * kPi * r) / (2 * kPi)
                 : 0;
}
}  // namespace

TEST(Kernel, ExactIsEq5) {
    for (int i = 0; i <= 1100; i++)
        EXPECT_NEAR(kernelExact(i / 1000.0), asPrinted(i / 1000.0), 1e-15);
    EXPECT_EQ(kernelExact(0), 1);
    EXPECT_EQ(kernelExact(1), 0);
    EXPECT_NEAR(kernelExact(0.5), 1.0 / 6, 1e-15);
}

TEST(Kernel, ExactKeepsItsDigitsAtTheEdge) {
    // Leading term of the series at r = 1: (2 pi)^4 / 180 * (1 - r)^5.
    for (const double e : {1e-3, 1e-4, 1e-6})
        EXPECT_NEAR(kernelExact(1 - e) / (std::pow(2 * kPi, 4) / 180 * std::pow(e, 5)), 1,
                    20 * e * e + 1e-9);
}

TEST(Kernel, FallsMonotonically) {
    for (int i = 0; i < 1000; i++)
        EXPECT_GT(kernelExact(i / 1000.0), kernelExact((i + 1) / 1000.0));
}

TEST(Kernel, PolynomialsHoldTheirRelativeErrors) {
    double worst_square = 0, worst_radius = 0;
    for (int i = 0; i < 9999; i++) {
        const double r = i / 10000.0, exact = kernelExact(r);
        worst_square =
            std::max(worst_square, std::abs(kernelOfSquare(r * r, 1 - r * r) / exact - 1));
        const DoubleRow row = kernelOfRadius<DoubleRow>(DoubleRow{r, r, r, r});
        worst_radius = std::max(worst_radius, std::abs(row[0] / exact - 1));
    }
    EXPECT_LT(worst_square, 1.2e-4);
    EXPECT_LT(worst_radius, 1.4e-8);
    const DoubleRow outside = kernelOfRadius<DoubleRow>(DoubleRow{1, 1.5, 10, 1e6});
    for (int i = 0; i < 4; i++) EXPECT_EQ(outside[i], 0);
}
