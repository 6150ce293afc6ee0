// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "queries/options.h"

#include "support/require.h"

namespace akimap {

void LikelihoodParameters::validate() const {
    require(decimation >= 1, "decimation", decimation, ">= 1");
    requireNonNegative("sigma_hit", sigma_hit);
    requireProbability("p_unknown", p_unknown);
    requireProbability("p_outlier", p_outlier);
    requirePositive("independent_returns", independent_returns);
}

}  // namespace akimap
