// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <nlohmann/json.hpp>
#include <ostream>
#include <string>
#include <vector>

#include "evaluation/evaluate.h"
#include "pictures/plot/plot.h"

namespace akimap::app {

/** How the errors of a set of cells depend on the threshold and on the occupancy. */
struct Curves {
    std::vector<RocPoint> roc;
    Reliability reliability;
};

/** All that is told of one map. */
struct Judgement {
    std::string name;  ///< of the map's file, as given
    Evaluation evaluation;
    Curves known, all;
};

/** Takes the cells by value because they are sorted. */
[[nodiscard]] Judgement judge(const std::string& name, ScoredCells cells);

/** Rows: the figures; columns: known and all. Undefined figures are shown as '-'. */
void printTable(const Evaluation& evaluation, std::ostream& out);

/** Two columns for each map, and two for the difference of each from the first. */
void printTable(const std::vector<Judgement>& maps, std::ostream& out);

/** Flat: known_auc, ..., all_cells, coverage. Undefined figures are null. */
[[nodiscard]] nlohmann::ordered_json toJson(const Evaluation& evaluation);

/** The first map's name, figures and curves, and the others' in `compare`. A curve is an object of
 * equally long arrays. */
[[nodiscard]] nlohmann::ordered_json toJson(const std::vector<Judgement>& maps);

/** The ROC curves of all maps. \exception std::runtime_error if there is none: one class is missing
 */
[[nodiscard]] Figure rocFigure(const std::vector<Judgement>& maps);

/** Reliability of all maps over the cells that they know, above the number of cells in each bin. */
[[nodiscard]] Figure calibrationFigure(const std::vector<Judgement>& maps);

}  // namespace akimap::app
