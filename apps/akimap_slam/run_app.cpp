// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "run_app.h"

#include <cstdlib>
#include <exception>
#include <iostream>
#include <stdexcept>

#include "errors.h"

namespace akimap::app {

namespace {

const Results* unpublished = nullptr;  // of the application that runs

/** For what is thrown in a thread, where nobody can catch it. */
[[noreturn]] void endInOneLine() {
    std::string reason = "ended without saying why";
    try {
        if (const auto thrown = std::current_exception()) std::rethrow_exception(thrown);
    } catch (const std::exception& e) {
        reason = reasonOf(e.what());
    } catch (...) {
    }
    if (unpublished) unpublished->discard();
    std::cerr << "akimap: " << reason << std::endl;
    std::_Exit(1);
}

}  // namespace

void addInputs(CLI::App& command, AppRequest& request, const std::string& config_help) {
    command.add_option("CONFIG", request.config, config_help)->required()->default_str("");
    command.add_option("RAWLOG", request.rawlog, "The log to run through")
        ->required()
        ->default_str("");
    command.add_flag("--allow-external", request.allow_external,
                     "Take what the log keeps in other files from outside its folder too");
}

void addOutputs(CLI::App& command, AppRequest& request) {
    command
        .add_option("-o,--output", request.folder,
                    "Folder for the results [default: the INI's logOutput_dir]")
        ->type_name("DIR")
        ->default_str("");
    command.add_flag("--verbose", request.verbose, "Show MRPT's log");
}

std::string outputFolder(const AppRequest& request, const Ini& ini, const std::string& section) {
    if (!request.folder.empty()) return request.folder;
    const std::string folder = iniValue(ini, section, "logOutput_dir");
    if (folder.empty())
        throw std::runtime_error(request.config + ": [" + section +
                                 "] has no logOutput_dir; say where to write with -o");
    return folder;
}

void quietDown(Ini& ini, const std::string& section, const AppRequest& request,
               mrpt::system::COutputLogger& app) {
    for (const char* window :
         {"SHOW_PROGRESS_3D_REAL_TIME", "SHOW_PROGRESS_IN_WINDOW", "DO_SCAN_LIKELIHOOD_DEBUG"})
        ini.write(section, window, false);
    if (request.verbose) return;
    app.setMinLoggingLevel(mrpt::system::LVL_ERROR);
    for (const char* key : {"verbosity", "verbosity_level"})
        ini.write(section, key, std::string("ERROR"));
}

void runApp(const AppRequest& request, const std::function<void()>& run, const LogFeed& feed,
            const Results& results) {
    unpublished = &results;
    const auto old_handler = std::set_terminate(endInOneLine);
    try {
        run();
    } catch (const std::exception& e) {
        std::set_terminate(old_handler);
        feed.rethrowFailure();
        throw std::runtime_error(request.config + ": " + reasonOf(e.what()));
    }
    std::set_terminate(old_handler);
    feed.requireSuccess();
}

}  // namespace akimap::app
