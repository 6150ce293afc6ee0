// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace akimap::app {

/** CLI11's help, with descriptions broken into lines of at most 100 columns. */
class HelpFormatter : public CLI::Formatter {
 public:
    HelpFormatter() { column_width(kNames); }

    [[nodiscard]] std::string make_option_desc(const CLI::Option* option) const override;
    [[nodiscard]] std::string make_subcommand(const CLI::App* command) const override;

    static constexpr std::size_t kWidth = 100, kNames = 36;
};

/** Puts two command lines, without the leading "akimap", below a command's help. */
void addExamples(CLI::App& command, const std::string& first, const std::string& second);

}  // namespace akimap::app
