// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <string>

#include "report/Report.h"
#include "watched_walk.h"

namespace akimap::bench {

/** A table: what AkiMap (its default and the paper's method) and OctoMap hold of someone who walks
 * by and keep of them, in occupied cells, and how long. "where they are" and "where they were" are
 * means over the scans while someone is there. */
[[nodiscard]] std::string movingSection(Report& report, const WatchedWalk& walk);

}  // namespace akimap::bench
