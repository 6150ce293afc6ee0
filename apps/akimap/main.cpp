// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <akimap/AkiMap.h>

#include <algorithm>
#include <iostream>
#include <string>
#include <vector>

#include "commands.h"
#include "errors.h"

namespace {

int run(int argc, char** argv) {
    CLI::App app{"Dense and sharp 3D occupancy maps by adaptive kernel inference (AKIMap).",
                 "akimap"};
    app.set_version_flag("--version", AKIMAP_VERSION);
    app.require_subcommand(1);
    app.get_formatter()->column_width(36);
    app.option_defaults()->always_capture_default();
    akimap::app::addBuild(app);
    akimap::app::addSimulate(app);
    akimap::app::addExport(app);
    akimap::app::addInfo(app);
    akimap::app::addQuery(app);
    akimap::app::addEval(app);
    akimap::app::addDefaultConfig(app);
    std::vector<std::string> arguments(argv + 1, argv + argc);
    for (std::string& a : arguments)
        if (a.rfind("-.", 0) == 0) a.insert(1, "0");  // CLI11 takes -.5 for an option
    std::reverse(arguments.begin(), arguments.end());
    try {
        app.parse(arguments);
        return 0;
    } catch (const CLI::ParseError& e) {
        if (e.get_exit_code() == 0) return app.exit(e);  // --help, --version
        std::cerr << "akimap: " << akimap::app::reasonOf(e.what()) << "\n";
        return 2;
    }
}

}  // namespace

int main(int argc, char** argv) {
    try {
        akimap::registerClasses();
        return run(argc, argv);
    } catch (const std::exception& e) {
        std::cerr << "akimap: " << akimap::app::reasonOf(e.what()) << "\n";
        return 1;
    }
}
