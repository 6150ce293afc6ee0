// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "evaluation/report.h"

namespace akimap::bench {

/** Which of two figures wins. */
enum class Better { higher, lower, neither };

/** What all methods came to in one figure: a column of a table. */
struct Contested {
    std::string name;
    Better better;
    std::vector<double> values;  ///< by method
    int decimals = 3;
};
/** The figures as text, the best in bold, equally good ones too.
 * \param methods their names
 * \param competing so many of them, the first ones, can be the best
 * \param where a place; if the first method is not the best there, `lost` gets an entry */
[[nodiscard]] std::vector<std::string> cellsOf(
    const Contested& figure, const std::vector<std::string>& methods, std::size_t competing,
    const std::string& where, std::vector<std::pair<std::string, std::string>>& lost);

/** One column of a table of accuracy. */
struct Column {
    const char* name;
    double (*value)(const app::Evaluation&);
    Better better;
};
/** Against a truth. */
[[nodiscard]] const std::vector<Column>& accuracyColumns();

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
