// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
//
// Log-loss, calibration and ROC points, and figures of maps whose errors are known.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "evaluation/evaluate.h"

namespace {

using namespace akimap::app;

double trapezoidArea(const std::vector<RocPoint>& curve) {
    double area = 0;
    for (std::size_t i = 1; i < curve.size(); i++)
        area += (curve[i].false_positive_rate - curve[i - 1].false_positive_rate) *
                (curve[i].true_positive_rate + curve[i - 1].true_positive_rate) / 2;
    return area;
}

/** Occupied as often as they say. */
std::vector<ScoredCell> calibratedCells(std::size_t n) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<ScoredCell> cells(n);
    for (ScoredCell& c : cells) {
        c.occupancy = unit(random);
        c.occupied = unit(random) < c.occupancy;
    }
    return cells;
}

TEST(Calibration, HandComputed) {
    // Two bins: {.11, .19}, half of them occupied, and {.92, .94, 1}, two of three occupied.
    const std::vector<ScoredCell> cells = {
        {0.11, true}, {0.19, false}, {0.92, true}, {0.94, true}, {1, false}};
    const Reliability bins = reliability(cells);
    EXPECT_EQ(bins[1].cells, 2u);
    EXPECT_EQ(bins[9].cells, 3u);
    EXPECT_NEAR(bins[1].mean_occupancy, 0.15, 1e-12);
    EXPECT_NEAR(bins[9].occupied_fraction, 2. / 3, 1e-12);
    EXPECT_EQ(bins[0].cells, 0u);
    EXPECT_TRUE(std::isnan(bins[0].mean_occupancy));
    EXPECT_TRUE(std::isnan(bins[0].occupied_fraction));
    const Scores s = score(cells);
    EXPECT_NEAR(s.calibration_error, (2 * (0.5 - 0.15) + 3 * (2.86 / 3 - 2. / 3)) / 5, 1e-12);
    const double loss = std::log(0.11) + std::log(0.81) + std::log(0.92) + std::log(0.94) +
                        std::log(0.01);  // 1 is clamped to 0.99
    EXPECT_NEAR(s.log_loss, -loss / 5, 1e-12);
}

TEST(Calibration, BinsHoldTheirLowerEdge) {
    for (std::size_t i = 0; i < 10; i++) {
        const double edge = static_cast<double>(i) / 10;
        EXPECT_EQ(reliability({{edge, true}})[i].cells, 1u) << edge;
        EXPECT_EQ(reliability({{edge + 0.1 - 1e-12, true}})[i].cells, 1u) << edge;
    }
    EXPECT_EQ(reliability({{1, true}})[9].cells, 1u);
}

TEST(Calibration, WithoutCellsIsUndefined) {
    const Scores s = score(std::vector<ScoredCell>{});
    EXPECT_TRUE(std::isnan(s.calibration_error));
    EXPECT_TRUE(std::isnan(s.log_loss));
    EXPECT_TRUE(std::isnan(s.mse));
}

TEST(Calibration, CellsAsOccupiedAsTheySayHaveNoError) {
    const auto cells = calibratedCells(200000);
    EXPECT_LT(score(cells).calibration_error, 0.005);
    for (const ReliabilityBin& bin : reliability(cells))
        EXPECT_NEAR(bin.occupied_fraction, bin.mean_occupancy, 0.015);
    auto overconfident = cells;
    for (ScoredCell& c : overconfident) c.occupancy = c.occupancy < 0.5 ? 0.05 : 0.95;
    // The truth is 1/4 and 3/4 in the two bins.
    EXPECT_NEAR(score(overconfident).calibration_error, 0.2, 0.005);
}

TEST(Roc, TiesAreOneStep) {
    const auto curve = roc({{0.2, false}, {0.9, true}, {0.5, true}, {0.5, false}, {0.5, false}});
    ASSERT_EQ(curve.size(), 4u);
    const double x[] = {0, 0, 2. / 3, 1}, y[] = {0, 0.5, 1, 1};
    for (std::size_t i = 0; i < 4; i++) {
        EXPECT_NEAR(curve[i].false_positive_rate, x[i], 1e-12) << i;
        EXPECT_NEAR(curve[i].true_positive_rate, y[i], 1e-12) << i;
    }
}

TEST(Roc, OfOneClassThereIsNone) {
    EXPECT_TRUE(roc({{0.2, true}, {0.9, true}}).empty());
    EXPECT_TRUE(roc({{0.2, false}}).empty());
    EXPECT_TRUE(roc({}).empty());
}

TEST(Roc, ItsAreaIsTheAuc) {
    const auto few = calibratedCells(700);
    EXPECT_NEAR(trapezoidArea(roc(few)), score(few).auc, 1e-12);
    for (const std::size_t n : {2000u, 300000u}) {
        const auto many = calibratedCells(n);
        const auto curve = roc(many);
        EXPECT_NEAR(trapezoidArea(curve), score(many).auc, 1e-4) << n << " cells";
        EXPECT_LE(curve.size(), 1001u);
        EXPECT_GT(curve.size(), 300u);
        for (std::size_t i = 1; i < curve.size(); i++) {
            EXPECT_GE(curve[i].false_positive_rate, curve[i - 1].false_positive_rate);
            EXPECT_GE(curve[i].true_positive_rate, curve[i - 1].true_positive_rate);
        }
        EXPECT_EQ(curve.front().true_positive_rate, 0);
        EXPECT_EQ(curve.back().false_positive_rate, 1);
        EXPECT_EQ(curve.back().true_positive_rate, 1);
    }
}

TEST(Roc, ThinningKeepsCorners) {
    // Every free cell is below every occupied one; 5000 steps up, then 5000 to the right.
    std::vector<ScoredCell> cells;
    for (int i = 0; i < 10000; i++) cells.push_back({i / 10000., i >= 5000});
    EXPECT_NEAR(trapezoidArea(roc(cells)), 1, 1e-5);
}

/** A row of cells of 0.1 m along x: free up to 0, occupied beyond. */
Truth rowOf(int free, int occupied) {
    Truth truth;
    truth.resolution = 0.1;
    for (int i = -free; i < occupied; i++) truth.leaves.push_back({{i, 0, 0}, 1, i >= 0});
    return truth;
}

Evaluation judged(double free_up_to, double p_free, double p_occupied) {
    return evaluate([&](double x, double, double) { return x < free_up_to ? p_free : p_occupied; },
                    0.1, rowOf(6, 4));
}

TEST(KnownMaps, AlwaysOneHalf) {
    const Scores s = judged(0, 0.5, 0.5).known;
    EXPECT_EQ(s.auc, 0.5);
    EXPECT_EQ(s.mse, 0.25);
    EXPECT_NEAR(s.log_loss, std::log(2), 1e-12);
    EXPECT_NEAR(s.calibration_error, 0.1, 1e-12);  // 0.5 against 4 of 10
}

TEST(KnownMaps, Perfect) {
    const Scores s = judged(0, 0, 1).known;
    EXPECT_EQ(s.auc, 1);
    EXPECT_EQ(s.mse, 0);
    EXPECT_NEAR(s.log_loss, -std::log(0.99), 1e-12);
    EXPECT_EQ(s.calibration_error, 0);
}

TEST(KnownMaps, Inverted) {
    const Scores s = judged(0, 1, 0).known;
    EXPECT_EQ(s.auc, 0);
    EXPECT_EQ(s.mse, 1);
    EXPECT_NEAR(s.log_loss, -std::log(0.01), 1e-12);
    EXPECT_EQ(s.calibration_error, 1);
}

TEST(KnownMaps, ShiftedByOneCell) {
    // Of 4 occupied cells 1 is called free, of 6 free ones none is called occupied.
    const Scores s = judged(0.1, 0.1, 0.8).known;
    EXPECT_NEAR(s.auc, (3 * 6 + 1 * 6 * 0.5) / 24, 1e-12);
    EXPECT_NEAR(s.mse, (6 * 0.01 + 0.81 + 3 * 0.04) / 10, 1e-12);
    EXPECT_NEAR(s.log_loss, -(6 * std::log(0.9) + std::log(0.1) + 3 * std::log(0.8)) / 10, 1e-12);
    EXPECT_NEAR(s.calibration_error, (7 * (1. / 7 - 0.1) + 3 * 0.2) / 10, 1e-12);
    EXPECT_EQ(s.occupied.precision, 1);
    EXPECT_EQ(s.occupied.recall, 0.75);
}

TEST(KnownMaps, OccupanciesThatAreNoProbabilitiesAreRefused) {
    EXPECT_THROW((void)judged(0, 0, 1.01), std::runtime_error);
    EXPECT_THROW((void)judged(0, -0.01, 1), std::runtime_error);
    EXPECT_THROW((void)judged(0, std::nan(""), 1), std::runtime_error);
}

}  // namespace
