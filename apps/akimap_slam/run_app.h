// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <mrpt/system/COutputLogger.h>

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

#include "LogFeed.h"
#include "Results.h"
#include "config_checks.h"

namespace akimap::app {

/** The command line of `akimap slam` and `akimap localize`. */
struct AppRequest {
    std::string config, rawlog;
    std::string folder;  ///< for the results; empty: the INI's logOutput_dir
    bool verbose = false;
    bool allow_external = false;  ///< see ExternalFiles

    /** A log or simplemap that can be read: see CheckedLog. */
    [[nodiscard]] CheckedLog checked(const std::string& log) const {
        return {log, allow_external ? ExternalFiles::anywhere : ExternalFiles::beside_log};
    }
};

/** Adds CONFIG, RAWLOG and --allow-external. */
void addInputs(CLI::App& command, AppRequest& request, const std::string& config_help);
/** Adds the options that say where results go and how much is told. */
void addOutputs(CLI::App& command, AppRequest& request);

/** One of mrpt::apps, fed by a LogFeed. */
template <class App>
class FedApp : public App {
 public:
    explicit FedApp(LogFeed& feed) : feed_(feed) {}

 private:
    bool impl_get_next_observations(mrpt::obs::CActionCollection::Ptr& actions,
                                    mrpt::obs::CSensoryFrame::Ptr& frame,
                                    mrpt::obs::CObservation::Ptr& observation) override {
        return feed_.next(actions, frame, observation);
    }
    LogFeed& feed_;
};

/** The folder for the results. \exception std::runtime_error if neither names one */
[[nodiscard]] std::string outputFolder(const AppRequest& request, const Ini& ini,
                                       const std::string& section);

/** Settings that every one of the applications needs: no windows, which end with "press any key",
 * and no log unless asked for. */
void quietDown(Ini& ini, const std::string& section, const AppRequest& request,
               mrpt::system::COutputLogger& app);

/** Runs `run` such that what it throws, even in threads of MRPT's, ends in one line and leaves no
 * scratch folder. \exception std::runtime_error naming the INI */
void runApp(const AppRequest& request, const std::function<void()>& run, const LogFeed& feed,
            const Results& results);

}  // namespace akimap::app
