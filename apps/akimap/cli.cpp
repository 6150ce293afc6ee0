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
#include "help.h"
#include "input/bags/BagSource.h"
#include "support/pending_files.h"
#include "support/similar.h"

namespace akimap::app {

namespace {

constexpr const char* kStatusTable =
    "Exit status: 0 done; 1 failed, and one line on stderr says why; 2 wrong command line; 3\n"
    "interrupted by ^C or SIGTERM, and the map of the scans so far is written.";

std::string versionText() {
    const std::string bags = bagReaderName();
    return std::string("akimap ") + AKIMAP_VERSION +
           "\nROS 1 bags: " + (bags.empty() ? "not in this build" : bags);
}

/** Names that a mistyped word may be meant to be: commands, or options of the command. */
std::vector<std::string> namesFor(const CLI::App& app, const std::vector<std::string>& arguments,
                                  bool is_option) {
    std::vector<std::string> names;
    if (!is_option) {
        for (const auto* command : app.get_subcommands({})) names.push_back(command->get_name());
        return names;
    }
    for (const auto* command : app.get_subcommands({}))
        if (!arguments.empty() && command->get_name() == arguments.front())
            for (const auto* option : command->get_options())
                for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    return names;
}

/** The reason of a wrong command line, with what may have been meant. */
std::string explain(const CLI::App& app, const CLI::ParseError& e,
                    const std::vector<std::string>& arguments) {
    const std::string reason = reasonOf(e.what());
    const auto commands = namesFor(app, arguments, false);
    const std::string word = arguments.empty() ? "-" : arguments.front();
    if (word[0] != '-' && std::find(commands.begin(), commands.end(), word) == commands.end())
        return "no command '" + word + "'" + didYouMean(word, commands) +
               "; akimap --help lists them";
    for (const std::string& argument : arguments) {
        const std::string name = argument.substr(0, argument.find('='));
        if (name.rfind("--", 0) != 0 || reason.find(name) == std::string::npos) continue;
        const auto names = namesFor(app, arguments, true);
        if (std::find(names.begin(), names.end(), name) == names.end())
            return "no option " + name + didYouMean(name, names);
    }
    return reason;
}

int parseAndRun(std::vector<std::string> arguments,
                const std::vector<void (*)(CLI::App&)>& commands) {
    CLI::App app{"Dense and sharp 3D occupancy maps by adaptive kernel inference (AKIMap).",
                 "akimap"};
    app.set_version_flag("--version", [] { return versionText(); });
    app.require_subcommand(1);
    app.formatter(std::make_shared<HelpFormatter>());
    app.option_defaults()->always_capture_default();
    app.footer(kStatusTable);
    for (const auto add : commands) add(app);
    const std::vector<std::string> in_order = arguments;
    try {
        std::reverse(arguments.begin(), arguments.end());
        app.parse(std::move(arguments));
        return 0;
    } catch (const CLI::ParseError& e) {
        if (e.get_exit_code() == 0) return app.exit(e);  // --help, --version
        std::cerr << "akimap: " << explain(app, e, in_order) << "\n";
        return kUsage;
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
        return kFailed;
    } catch (const Interrupted& e) {
        std::cerr << "akimap: " << reasonOf(e.what()) << "\n";
        return kInterrupted;
    } catch (const std::exception& e) {
        std::cerr << "akimap: " << reasonOf(e.what()) << "\n";
        return kFailed;
    }
}

}  // namespace akimap::app
