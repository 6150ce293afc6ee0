// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <string>
#include <vector>

namespace akimap::bench {

/** A Markdown table; its columns are padded, so that it reads as plain text too. */
class MarkdownTable {
 public:
    explicit MarkdownTable(std::vector<std::string> header) : rows_{std::move(header)} {}
    /** \pre as many cells as the header has */
    void add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }
    [[nodiscard]] std::string text() const;

 private:
    std::vector<std::vector<std::string>> rows_;
};

/** With so many decimals; `–` if it is not finite. */
[[nodiscard]] std::string fixed(double value, int decimals);
[[nodiscard]] std::string bold(const std::string& text);

/** A picture beside the report, by its path from there. */
[[nodiscard]] std::string image(const std::string& alternative, const std::string& path);

/** Processor, cores, compiler and MRPT of this program's run: one sentence. */
[[nodiscard]] std::string describeMachine();

}  // namespace akimap::bench
