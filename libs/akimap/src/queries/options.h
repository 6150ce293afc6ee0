// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <akimap/Parameters.h>

namespace akimap {

/** Calls visit(name, field, comment) for each option. */
template <class Parameters, class Visitor>
void visitLikelihoodFields(Parameters& o, Visitor&& visit) {
    visit("decimation", o.decimation, ">= 1. Use one return in so many");
    visit("sigma_hit", o.sigma_hit,
          "[m] >= 0. Standard deviation of a return's end along its ray: sensor, map and pose");
    visit("p_unknown", o.p_unknown,
          "[-] in (0,1). Weight of a return that ends in the unknown; 1: on a surface, 0: in free");
    visit("p_outlier", o.p_outlier, "[-] in (0,1). Share of returns that no map explains");
    visit("independent_returns", o.independent_returns,
          "[-] > 0. An observation counts as at most so many independent returns");
}

}  // namespace akimap
