// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <cmath>
#include <cstdint>
#include <random>

namespace akimap::app {

/** Seeded random numbers. The standard fixes the engine's bits but leaves its distributions to
 * each library, so these are our own: a seed gives the same drive everywhere. */
class Random {
 public:
    /** \param stream  keeps the uses of one seed independent of each other */
    Random(uint64_t seed, uint32_t stream) {
        std::seed_seq mix{static_cast<uint32_t>(seed), static_cast<uint32_t>(seed >> 32), stream};
        engine_.seed(mix);
    }

    /** Uniform in [low, high). */
    double uniform(double low, double high) {
        constexpr double kUnit = 1.0 / 9007199254740992.0;  // 2^-53
        return low + (high - low) * static_cast<double>(engine_() >> 11) * kUnit;
    }
    /** Gaussian of zero mean (Box-Muller; the second variate is dropped). */
    double normal(double sigma) {
        const double radius = std::sqrt(-2 * std::log(1 - uniform(0, 1)));
        return sigma * radius * std::cos(uniform(0, 2 * M_PI));
    }

 private:
    std::mt19937_64 engine_;
};

}  // namespace akimap::app
