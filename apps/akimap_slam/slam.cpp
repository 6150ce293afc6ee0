// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <mrpt/apps/ICP_SLAM_App.h>
#include <mrpt/apps/RBPF_SLAM_App.h>

#include <iostream>

#include "help.h"
#include "run_app.h"
#include "slam_commands.h"

namespace akimap::app {

namespace {

constexpr const char* kSection = "MappingApplication";

constexpr const char* kFooter =
    "CONFIG is an INI file of MRPT's icp-slam or rbpf-slam. With akimap_count = 1 in its\n"
    "[MappingApplication], beside the maps that those need, they build an AkiMap too\n"
    "(akimap default-config prints its sections). The log of the INI is not used, no windows\n"
    "are shown, and what else is in the output folder is left alone.\n"
    "^C ends the log there; the results are written.\n";

struct SlamRequest : AppRequest {
    std::string method;  ///< icp, rbpf, or empty
};

std::string methodFor(const SlamRequest& request, const Ini& ini) {
    if (!request.method.empty()) return request.method;
    if (ini.keyExists(kSection, "PF_algorithm")) return "rbpf";
    if (ini.sectionExists("ICP")) return "icp";
    throw std::runtime_error(request.config + ": neither an [ICP] section nor a PF_algorithm in [" +
                             kSection + "]; choose with --method");
}

template <class App>
void runSlam(const SlamRequest& request, Ini ini, LogFeed::Form form,
             const std::string& map_prefix) {
    LogFeed feed(request.checked(request.rawlog), form,
                 ini.read_uint64_t(kSection, "rawlog_offset", 0));
    Results results(outputFolder(request, ini, kSection));
    FedApp<App> app(feed);
    quietDown(ini, kSection, request, app);
    ini.write(kSection, "logOutput_dir", results.scratch());
    app.quits_with_esc_key = false;
    app.params = withRegisteredMaps(ini, kSection);
    runApp(
        request, [&] { app.run(); }, feed, results);
    results.publish(map_prefix, {app.out_estimated_path.begin(), app.out_estimated_path.end()});
}

void slam(const SlamRequest& request) {
    const Ini ini = readIni(request.config);
    requireSection(ini, request.config, kSection);
    const std::string method = methodFor(request, ini);
    if (!checkMaps(ini, request.config, kSection))
        std::cerr << "akimap: warning: " << request.config << ": [" << kSection
                  << "] has no akimap_count = 1: no AkiMap is built\n";
    if (method == "icp") {
        requireSection(ini, request.config, "ICP");
        runSlam<mrpt::apps::ICP_SLAM_App_Rawlog>(request, ini, LogFeed::Form::as_recorded,
                                                 "_finalmaps_");
    } else {
        runSlam<mrpt::apps::RBPF_SLAM_App_Rawlog>(request, ini, LogFeed::Form::pairs, "finalMap");
    }
}

}  // namespace

void addSlam(CLI::App& app) {
    auto* command = app.add_subcommand("slam", "Run MRPT's ICP or RBPF SLAM with an AkiMap");
    const auto request = std::make_shared<SlamRequest>();
    addInputs(*command, *request, "INI of icp-slam or rbpf-slam");
    command
        ->add_option("--method", request->method,
                     "icp or rbpf [default: rbpf if the INI's [MappingApplication] has a "
                     "PF_algorithm, else icp if there is an [ICP] section]")
        ->check(CLI::IsMember({"icp", "rbpf"}))
        ->type_name("NAME")
        ->default_str("");
    addOutputs(*command, *request);
    command->footer(kFooter);
    addExamples(*command, "slam icp-slam.ini drive.rawlog",
                "slam rbpf-slam.ini drive.rawlog --method rbpf");
    command->callback([request] { slam(*request); });
}

}  // namespace akimap::app
