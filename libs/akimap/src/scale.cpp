// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "scale.h"

#include <algorithm>
#include <cmath>

#include "kernel.h"

namespace akimap {
namespace {

constexpr int kCandidates = 16;
constexpr double kTolerance = 1e-3;

float kernelAt(float u) { return u < 1 ? kernelOfSquare(u, 1 - u) : 0.0f; }

double goldenSection(const SupportNeighbors& n, double a, double b) {
    constexpr double kRatio = 0.6180339887498949;
    double c = b - kRatio * (b - a), d = a + kRatio * (b - a);
    double fc = scaleObjective(n, c), fd = scaleObjective(n, d);
    while (b - a > kTolerance) {
        if (fc < fd) {
            b = d, d = c, fd = fc;
            fc = scaleObjective(n, c = b - kRatio * (b - a));
        } else {
            a = c, c = d, fc = fd;
            fd = scaleObjective(n, d = a + kRatio * (b - a));
        }
    }
    return fc < fd ? c : d;
}

}  // namespace

double scaleObjective(const SupportNeighbors& n, double s) {
    const float shrink = static_cast<float>(1 / (s * s));
    double sum = 0;
    for (const float u : n.positive) {
        const float miss = kernelAt(u) - kernelAt(u * shrink);
        sum += miss * miss;
    }
    for (const float u : n.negative) {
        const float k = kernelAt(u * shrink);
        sum += k * k;
    }
    return sum / (s * s * s);
}

double bestScale(const SupportNeighbors& n, double lowest, double highest) {
    if (lowest >= highest) return highest;
    const double step = (highest - lowest) / (kCandidates - 1);
    double best = highest, value = scaleObjective(n, highest);
    for (int i = 0; i < kCandidates - 1; i++) {
        const double s = lowest + i * step, f = scaleObjective(n, s);
        if (f < value) best = s, value = f;
    }
    const double polished =
        goldenSection(n, std::max(lowest, best - step), std::min(highest, best + step));
    return scaleObjective(n, polished) < value ? polished : best;
}

}  // namespace akimap
