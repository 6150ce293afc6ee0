// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "evaluation/report.h"

namespace akimap::bench {

/** One column of a table of accuracy. */
struct Column {
    const char* name;
    double (*value)(const app::Evaluation&);
    enum class Better { higher, lower, neither } better;
};
/** Against a truth. */
[[nodiscard]] const std::vector<Column>& accuracyColumns();
/** Against held-out scans. */
[[nodiscard]] const std::vector<Column>& heldOutColumns();

/** One method's figures over several runs. */
struct Row {
    std::string name;
    std::vector<double> means;  ///< by column
    std::size_t runs;
    double largest_deviation;  ///< the largest standard deviation of any column; NaN for one run
    std::vector<std::string> more;  ///< cells behind
};
[[nodiscard]] Row summarize(const std::string& name, const std::vector<Column>& columns,
                            const std::vector<app::Evaluation>& runs);

/** The rows as a Markdown table, the best of each column in bold.
 * \param more headers of Row::more
 * \param lost gets an entry for each column in which the first row is not the best
 * \param where for those entries */
[[nodiscard]] std::string tableOf(const std::vector<Row>& rows, const std::vector<Column>& columns,
                                  const std::vector<std::string>& more, const std::string& where,
                                  std::vector<std::pair<std::string, std::string>>& lost);

/** ROC curves over the cells that each map knows. */
[[nodiscard]] app::Figure rocOfKnown(const std::vector<app::Judgement>& maps);

}  // namespace akimap::bench
