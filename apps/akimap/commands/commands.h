// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <CLI/CLI.hpp>

namespace akimap::app {

// Each adds one subcommand with its options; its callback does the work and throws
// std::exception with a message that names the file and the thing. main() prints that on one
// line and exits with 1.
void addBuild(CLI::App& app);
void addConvert(CLI::App& app);
void addCheck(CLI::App& app);
void addSimulate(CLI::App& app);
void addExport(CLI::App& app);
void addInfo(CLI::App& app);
void addQuery(CLI::App& app);
void addEval(CLI::App& app);
void addHoldout(CLI::App& app);
void addDefaultConfig(CLI::App& app);

}  // namespace akimap::app
