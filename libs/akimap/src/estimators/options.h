// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <akimap/Parameters.h>

#include <array>
#include <string>
#include <vector>

#include "estimators/paper/options.h"
#include "estimators/surface/options.h"

// Each option's name, unit and meaning, said once: reading, writing, streaming and --help all go
// through these lists, visitFields(parameters, visit), which call visit(name, field, comment). The
// estimators' own options are listed in their folders.

namespace akimap {

[[nodiscard]] constexpr auto enumNames(Estimator) {
    return std::array{"paper", "surface"};
}
[[nodiscard]] constexpr auto enumNames(BeyondMaxRange) {
    return std::array{"ignore", "free"};
}

template <class Parameters, class Visitor>
void visitScanFields(Parameters& o, Visitor&& visit) {
    visit("min_range", o.min_range, "[m] >= 0. Returns nearer to their ray's origin are dropped");
    visit("max_range", o.max_range, "[m] > min_range. Returns farther away are dropped");
    visit("beyond_max_range", o.beyond_max_range,
          "ignore | free: how beams without a return up to max_range are used");
    visit("prior_alpha", o.prior_alpha, "[-] > 0. Beta prior of each cell: occupied");
    visit("prior_beta", o.prior_beta, "[-] > 0. Beta prior of each cell: free");
    visit("threads", o.threads, "0: all cores. The map does not depend on it");
}

/** Calls visit(estimator, its parameters, function that visits their fields) for each estimator. */
template <class Parameters, class Visitor>
void visitEstimatorOptions(Parameters& o, Visitor&& visit) {
    visit(Estimator::surface, o, [](auto& p, auto&& v) { visitSurfaceFields(p, v); });
    visit(Estimator::paper, o, [](auto& p, auto&& v) { visitPaperFields(p, v); });
}

/** void where P is the given parameters, const or not, or options made of them. */
template <class Wanted, class P>
using IfFieldsOf = std::enable_if_t<std::is_base_of_v<Wanted, std::remove_const_t<P>>>;

template <class Parameters, class Visitor>
IfFieldsOf<InsertionParameters, Parameters> visitFields(Parameters& o, Visitor&& visit) {
    visit("estimator", o.estimator,
          "surface (fitted to hits, free space around rays) | paper (the paper's method)");
    visitScanFields(o, visit);
    visitEstimatorOptions(o, [&](Estimator, auto& p, auto&& visitOwn) { visitOwn(p, visit); });
}

/** The names of options of estimators that are not in use, set away from their defaults: they
 * change nothing. */
[[nodiscard]] std::vector<std::string> idleOptions(const InsertionParameters& p);

}  // namespace akimap
