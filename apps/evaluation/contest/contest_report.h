// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <nlohmann/json.hpp>
#include <ostream>

#include "evaluation/contest/contest.h"

namespace akimap::app {

/** Rows: the figures; columns: the maps. Undefined figures are shown as '-'. */
void printTable(const ContestResult& result, std::ostream& out);

/** What printTable() shows, without rounding, and the shares of each held-out scan. Undefined
 * figures are null; depths are in metres. */
[[nodiscard]] nlohmann::ordered_json toJson(const ContestResult& result);

}  // namespace akimap::app
