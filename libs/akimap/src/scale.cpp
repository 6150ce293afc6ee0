// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "scale.h"

#include <algorithm>
#include <cmath>

#include "kernel.h"

namespace akimap {
namespace {

constexpr int kCandidates = 16;
constexpr double kTolerance = 1e-5;

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

/** Derivative of Eq. (5) by r, with its formula also beyond r = 1, as the authors' code has it. */
double kernelSlope(double r) {
    constexpr double kPi = 3.14159265358979323846;
    return -2.0 / 3 * (kPi * (1 - r) * std::sin(2 * kPi * r) + 1 - std::cos(2 * kPi * r));
}

}  // namespace

void ScaleProblem::clear() {
    size_ = 0;
    r_.clear();
    target_.clear();
}

void ScaleProblem::add(float u, bool positive) {
    constexpr double kFar = 1e9;  // padding: neighbours that no kernel reaches
    if (size_ == r_.size()) {
        r_.resize(size_ + 4, kFar);
        target_.resize(size_ + 4, 0);
    }
    const double r = std::sqrt(static_cast<double>(u));
    r_[size_] = r;
    // By the polynomial, so that an unchanged scale misses no target.
    target_[size_++] = positive ? kernelOfRadius(r) : 0;
}

double ScaleProblem::objective(double s) const {
    return sumOfSquares(r_.data(), target_.data(), r_.size(), s) / (s * s * s);
}

double ScaleProblem::polish(double a, double b) const {
    constexpr double kRatio = 0.6180339887498949;
    double c = b - kRatio * (b - a), d = a + kRatio * (b - a);
    double fc = objective(c), fd = objective(d);
    while (b - a > kTolerance) {
        if (fc < fd) {
            b = d, d = c, fd = fc;
            fc = objective(c = b - kRatio * (b - a));
        } else {
            a = c, c = d, fc = fd;
            fd = objective(d = a + kRatio * (b - a));
        }
    }
    return fc < fd ? c : d;
}

double ScaleProblem::minimise(double lowest, double highest) const {
    if (lowest >= highest) return highest;
    const double step = (highest - lowest) / (kCandidates - 1);
    double best = highest, value = objective(highest);
    for (int i = kCandidates - 2; i >= 0;
         i--) {  // of equals, the largest: shrink only for a reason
        const double s = lowest + i * step, f = objective(s);
        if (f < value) best = s, value = f;
    }
    const double polished = polish(std::max(lowest, best - step), std::min(highest, best + step));
    const double at_polished = objective(polished);
    if (at_polished == value) return std::max(polished, best);
    return at_polished < value ? polished : best;
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
