// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "estimators/options.h"

#include "support/require.h"

namespace akimap {

void ScanParameters::validate() const {
    requireNonNegative("min_range", min_range);
    requirePositive("max_range", max_range);
    require(max_range > min_range, "max_range", max_range, "greater than min_range");
    requireNamed("beyond_max_range", beyond_max_range);
    requirePositive("prior_alpha", prior_alpha);
    requirePositive("prior_beta", prior_beta);
}

void InsertionParameters::validate() const {
    requireNamed("estimator", estimator);
    ScanParameters::validate();
    SurfaceParameters::validate();
    PaperParameters::validate();
}

std::vector<std::string> idleOptions(const InsertionParameters& p) {
    std::vector<double> defaults;
    std::vector<std::string> idle;
    const InsertionParameters fresh;
    visitEstimatorOptions(fresh, [&](Estimator, const auto& o, auto&& visitOwn) {
        visitOwn(o, [&](const char*, const auto& v, const char*) {
            defaults.push_back(static_cast<double>(v));
        });
    });
    std::size_t i = 0;
    visitEstimatorOptions(p, [&](Estimator estimator, const auto& o, auto&& visitOwn) {
        visitOwn(o, [&](const char* name, const auto& v, const char*) {
            const bool changed = static_cast<double>(v) != defaults[i++];
            if (changed && estimator != p.estimator) idle.emplace_back(name);
        });
    });
    return idle;
}

}  // namespace akimap
