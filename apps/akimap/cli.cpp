// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "cli.h"

#include <akimap/AkiMap.h>

#include <algorithm>
#include <csignal>
#include <iostream>
#include <new>
#include <stdexcept>
#include <string>

#include "errors.h"
#include "support/pending_files.h"

namespace akimap::app {

namespace {

int parseAndRun(std::vector<std::string> arguments,
                const std::vector<void (*)(CLI::App&)>& commands) {
    CLI::App app{"Dense and sharp 3D occupancy maps by adaptive kernel inference (AKIMap).",
                 "akimap"};
    app.set_version_flag("--version", AKIMAP_VERSION);
    app.require_subcommand(1);
    app.get_formatter()->column_width(36);
    app.option_defaults()->always_capture_default();
    for (const auto add : commands) add(app);
    try {
        std::reverse(arguments.begin(), arguments.end());
        app.parse(std::move(arguments));
        return 0;
    } catch (const CLI::ParseError& e) {
        if (e.get_exit_code() == 0) return app.exit(e);  // --help, --version
        std::cerr << "akimap: " << reasonOf(e.what()) << "\n";
        return 2;
    }
}

}  // namespace

int runCommands(int argc, char** argv, const std::vector<void (*)(CLI::App&)>& commands) {
    try {
        registerClasses();
        std::vector<std::string> arguments(argv + 1, argv + argc);
        for (std::string& a : arguments)
            if (a.rfind("-.", 0) == 0) a.insert(1, "0");  // CLI11 takes -.5 for an option
        removePendingFilesOnSignals();
        std::signal(SIGXFSZ, SIG_IGN);  // a file-size limit is an error like a full disk
        const int status = parseAndRun(std::move(arguments), commands);
        if (!std::cout.flush()) throw std::runtime_error("standard output can't be written");
        return status;
    } catch (const std::bad_alloc&) {
        std::cerr
            << "akimap: out of memory; a larger --resolution or a smaller --max-range helps\n";
        return 1;
    } catch (const std::exception& e) {
        std::cerr << "akimap: " << reasonOf(e.what()) << "\n";
        return 1;
    }
}

}  // namespace akimap::app
