// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include "methods.h"
#include "report/Report.h"

namespace akimap::bench {

/** The share of a scan's rays, spread over it at random; a smaller share's are among a larger's. */
[[nodiscard]] std::vector<PreparedScan> thin(const std::vector<std::vector<Ray>>& scans,
                                             double share, double max_range);

/** The paper's equal-time comparison: each method gets as much of the data, in steps of 5 %, as it
 * takes in within a budget: once the fastest kernel method's time for all data, once
 * BGKOctoMap-L's. */
[[nodiscard]] std::string equalTimeSection(Report& report, const Scene& scene,
                                           const std::string& name);

}  // namespace akimap::bench
