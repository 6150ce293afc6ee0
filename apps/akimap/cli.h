// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace akimap::app {

/** CLI11 takes -1 for the largest unsigned number. */
inline const CLI::Validator kWholeNumber{
    [](std::string& text) {
        return text.find_first_not_of("0123456789") == std::string::npos && text.size() < 20
                   ? std::string()
                   : "'" + text + "' is no whole number >= 0";
    },
    ""};

/** A program of subcommands, each added by a function of commands.h: parses, runs, and prints what
 * goes wrong on one line.
 * \return the exit status: 0, kFailed, kUsage or kInterrupted */
int runCommands(int argc, char** argv, const std::vector<void (*)(CLI::App&)>& commands);

}  // namespace akimap::app
