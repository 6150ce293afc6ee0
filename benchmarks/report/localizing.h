// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include "localization.h"
#include "report/Report.h"

namespace akimap::bench {

/** A table: errors of the poses that each map leads to, by ICP and by its likelihood. */
[[nodiscard]] std::string localizationSection(Report& report, const LocalizationCase& recording,
                                              const LocalizationRules& rules = {});

/** What localizationSection()'s columns mean. */
[[nodiscard]] std::string localizationLegend(const LocalizationRules& rules = {});

}  // namespace akimap::bench
