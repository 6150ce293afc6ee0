// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <akimap/AkiMap.h>

#include <iostream>

#include "commands.h"

namespace {

std::string oneLine(std::string text) {
    // MRPT's exceptions carry a backtrace behind their first line.
    if (const auto end = text.find("\n== BACKTRACE"); end != std::string::npos) text.resize(end);
    while (!text.empty() && text.back() == '\n') text.pop_back();
    for (char& c : text)
        if (c == '\n') c = ' ';
    return text;
}

int run(int argc, char** argv) {
    CLI::App app{"Dense and sharp 3D occupancy maps by adaptive kernel inference (AKIMap).", "akimap"};
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
    try {
        app.parse(argc, argv);
        return 0;
    } catch (const CLI::ParseError& e) {
        if (e.get_exit_code() == 0) return app.exit(e);  // --help, --version
        std::cerr << "akimap: " << oneLine(e.what()) << "\n";
        return 2;
    }
}

}  // namespace

int main(int argc, char** argv) {
    try {
        akimap::registerClasses();
        return run(argc, argv);
    } catch (const std::exception& e) {
        std::cerr << "akimap: " << oneLine(e.what()) << "\n";
        return 1;
    }
}
