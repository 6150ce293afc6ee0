// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "MapKind.h"
#include "Sample.h"

namespace akimap::bench {

/** A row of the table: what to call and how each class of maps answers. */
struct Row {
    std::string call;
    std::function<std::string(const MapKind&)> answer;
};
struct Section {
    std::string title, remark;
    std::vector<Row> rows;
    bool guarded = true;  ///< each answer from a process of its own
};

[[nodiscard]] Section insertionRows(const std::vector<Sample>&);
[[nodiscard]] Section likelihoodRows(const std::vector<Sample>&);
/** \param room  for ICP: returns from all sides */
[[nodiscard]] Section matchingRows(const Sample& room);
/** The map's own affairs: clearing, copies, files, pictures. \param folder  to write into */
[[nodiscard]] Section stateRows(const std::string& folder);
[[nodiscard]] Section settingsRows();
/** MRPT's programs, as installed, run in the folder. */
[[nodiscard]] Section programRows(const std::string& folder);

}  // namespace akimap::bench
