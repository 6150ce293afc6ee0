// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <iostream>

#include "commands/commands.h"
#include "help.h"
#include "mapping/config.h"

namespace akimap::app {

void addDefaultConfig(CLI::App& app) {
    auto* command = app.add_subcommand(
        "default-config", "Print a commented INI file that holds every option at its default");
    addExamples(*command, "default-config > akimap.ini", "default-config | grep max_range");
    command->callback([] {
        std::cout << defaultConfig() << std::flush;
        if (!std::cout) throw std::runtime_error("can't write to the standard output");
    });
}

}  // namespace akimap::app
