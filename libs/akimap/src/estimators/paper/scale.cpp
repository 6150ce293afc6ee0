// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "estimators/paper/scale.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "estimators/kernels/kernel_function.h"

namespace akimap {
namespace {

constexpr std::size_t kCandidates = 16, kCandidateRows = kCandidates / 4;
using Candidates = std::array<DoubleRow, kCandidateRows>;
constexpr double kTolerance = 2e-6;
constexpr double kFar = 1e9;  // padding: neighbours that no kernel reaches

/** Sum of (t - k(r / s))^2 over rows of four; n is a multiple of four. */
AKIMAP_MULTIVERSION
double sumOfSquares(const double* r, const double* target, std::size_t n, double s) {
    const double shrink = 1 / s;
    DoubleRow sum{};
    for (std::size_t i = 0; i < n; i += 4) {
        const DoubleRow radius = {r[i], r[i + 1], r[i + 2], r[i + 3]};
        const DoubleRow t = {target[i], target[i + 1], target[i + 2], target[i + 3]};
        const DoubleRow miss = t - kernelOfRadius<DoubleRow>(radius * shrink);
        sum += miss * miss;
    }
    return (sum[0] + sum[2]) + (sum[1] + sum[3]);
}

/** The derivative of Eq. (7) by s, times s^4 / 2; n is a multiple of four. */
AKIMAP_MULTIVERSION
double slopeOfSquares(const double* r, const double* target, std::size_t n, double s) {
    const double shrink = 1 / s;
    DoubleRow sum{};
    for (std::size_t i = 0; i < n; i += 4) {
        const DoubleRow radius = {r[i], r[i + 1], r[i + 2], r[i + 3]};
        const DoubleRow t = {target[i], target[i + 1], target[i + 2], target[i + 3]};
        const auto [k, fall] = kernelAndFall<DoubleRow>(radius * shrink);
        const DoubleRow miss = k - t;
        sum += miss * (fall - 1.5 * miss);
    }
    return (sum[0] + sum[2]) + (sum[1] + sum[3]);
}

/** The sums of (t - k(r / s))^2 over all points, for a scale in each lane. */
AKIMAP_MULTIVERSION
void sumsOfSquares(const double* r, const double* target, std::size_t n, const Candidates& shrink,
                   Candidates& sums) {
    DoubleRow total[kCandidateRows]{};
    for (std::size_t i = 0; i < n; i++)
        for (std::size_t c = 0; c < kCandidateRows; c++) {
            const DoubleRow miss = target[i] - kernelOfRadius<DoubleRow>(r[i] * shrink[c]);
            total[c] += miss * miss;
        }
    std::copy_n(total, kCandidateRows, sums.begin());
}

/** Derivative of Eq. (5) by r, with its formula also beyond r = 1, as the authors' code has it. */
double kernelSlope(double r) {
    constexpr double kPi = 3.14159265358979323846;
    return -2.0 / 3 * (kPi * (1 - r) * std::sin(2 * kPi * r) + 1 - std::cos(2 * kPi * r));
}

}  // namespace

void ScaleProblem::clear() {
    size_ = rows_end_ = 0, spread_ = false, nearest_negative_ = kFar;
}

void ScaleProblem::add(float u, bool positive) {
    if (size_ == rows_end_) startRow();
    const double r = std::sqrt(static_cast<double>(u));
    r_[size_] = r;
    // By the polynomial, so that an unchanged scale misses no target.
    target_[size_++] = positive ? kernelOfRadius(r) : 0;
    if (positive)
        spread_ |= u > 0;
    else
        nearest_negative_ = std::min(nearest_negative_, r);
}

void ScaleProblem::startRow() {
    rows_end_ += 4;
    if (rows_end_ > target_.size())  // the last: r_ may be longer, if memory ran out
        r_.resize(2 * rows_end_), target_.resize(2 * rows_end_);
    for (std::size_t i = size_; i < rows_end_; i++) r_[i] = kFar, target_[i] = 0;
}

double ScaleProblem::objective(double s) const {
    return sumOfSquares(r_.data(), target_.data(), rows_end_, s) / (s * s * s);
}

double ScaleProblem::bestCandidate(double lowest, double step) const {
    Candidates shrink{}, sums{};
    for (std::size_t i = 0; i < kCandidates; i++)
        shrink[i / 4][i % 4] = 1 / (lowest + static_cast<double>(i) * step);
    sumsOfSquares(r_.data(), target_.data(), size_, shrink, sums);
    std::size_t best = kCandidates - 1;
    const auto value = [&](std::size_t i) {
        const double by = shrink[i / 4][i % 4];
        return sums[i / 4][i % 4] * by * by * by;
    };
    for (std::size_t i = best; i-- > 0;)  // of equals, the largest: shrink only for a reason
        if (value(i) < value(best)) best = i;
    return lowest + static_cast<double>(best) * step;
}

/** The zero of the slope by false position; by bisection wherever that narrows [a, b] too little,
 * as the kernels' edges are of a high order. */
double ScaleProblem::polish(double a, double b) const {
    double slope_a = slope(a), slope_b = slope(b);
    if (slope_b <= 0) return b;
    if (slope_a >= 0) return a;
    bool halve = false;
    while (b - a > kTolerance) {
        const double width = b - a, share = halve ? 0.5 : slope_b / (slope_b - slope_a);
        const double s = std::clamp(b - share * width, a + kTolerance / 4, b - kTolerance / 4);
        const double at_s = slope(s);
        if (at_s > 0)
            b = s, slope_b = at_s;
        else
            a = s, slope_a = at_s;
        halve = b - a > width / 2;
    }
    return slope_b < -slope_a ? b : a;
}

double ScaleProblem::minimise(double lowest, double highest) const {
    if (lowest >= highest) return highest;
    // Positives that miss nothing at any scale: Eq. (7) is 0 until the first negative is reached.
    if (!spread_ && nearest_negative_ >= lowest) return std::min(nearest_negative_, highest);
    const double step = (highest - lowest) / (kCandidates - 1);
    const double best = bestCandidate(lowest, step);
    const double polished = polish(std::max(lowest, best - step), std::min(highest, best + step));
    const double value = objective(best), at_polished = objective(polished);
    if (at_polished == value) return std::max(polished, best);
    return at_polished < value ? polished : best;
}

double ScaleProblem::slope(double s) const {
    return slopeOfSquares(r_.data(), target_.data(), rows_end_, s);
}

double ScaleProblem::gradient(double weight, double s) const {
    double squares = 0, slopes = 0;
    for (std::size_t i = 0; i < size_; i++) {
        const double miss = target_[i] - kernelExact(r_[i] / s);
        squares += miss * miss;
        slopes -= miss * kernelSlope(r_[i] / s) * r_[i] / (s * s);
    }
    const double w = weight / (s * s * s);
    return -1.5 * w / s * squares - w * slopes;
}

double ScaleProblem::descend(double weight, double lowest) const {
    constexpr int kEpochs = 100;
    constexpr double kRate = 0.01, kStill = 1e-3;
    double s = 1;
    for (int epoch = 1; epoch <= kEpochs; epoch++) {
        const double slope = gradient(weight, s);
        const double next = std::clamp(s - kRate * slope / epoch, lowest, 1.0);
        const bool still = std::abs(slope) < kStill || weight / 2 * objective(s) < kStill ||
                           std::abs(next - s) < kStill;
        if (still) break;
        s = next;
    }
    return s;
}

}  // namespace akimap
