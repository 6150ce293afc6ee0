// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <CLI/CLI.hpp>

namespace akimap::app {

// As the commands of akimap itself, see its commands/commands.h.
void addSlam(CLI::App& app);
void addLocalize(CLI::App& app);

}  // namespace akimap::app
