// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include "methods.h"
#include "report/Report.h"

namespace akimap::bench {

/** All methods judged by every fifth scan, which they never get: a table and reliability curves.
 * The scene needs no truth. */
[[nodiscard]] std::string heldOutSection(Report& report, const Scene& scene,
                                         const std::string& name);

}  // namespace akimap::bench
