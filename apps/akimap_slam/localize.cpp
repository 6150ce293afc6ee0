// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <mrpt/apps/MonteCarloLocalization_App.h>

#include <cstdlib>
#include <filesystem>
#include <iostream>

#include "help.h"
#include "input/files.h"
#include "run_app.h"
#include "slam_commands.h"

namespace akimap::app {

namespace {

constexpr const char* kSection = mrpt::apps::MonteCarloLocalization_Base::sect;
constexpr const char* kMapSection = "MetricMap";

constexpr const char* kFooter =
    "CONFIG is an INI file of MRPT's pf-localization. With akimap_count = 1 in its [MetricMap] an\n"
    "AkiMap is built from its map_file (.simplemap) and weighs the particles; map_file is looked\n"
    "for from here, then from CONFIG's folder. An AkiMap as the only map needs init_PDF_mode = 1.\n"
    "The log of the INI is not used, no windows are shown, and what else is in the output folder\n"
    "is left alone. ^C ends the log there; the results are written.\n";

[[noreturn]] void refuse(const AppRequest& request, const std::string& what) {
    throw std::runtime_error(request.config + ": [" + kSection + "] " + what);
}

/** Refuses what would end MRPT's threads, with the program, or make them share one log. */
void checkExperiment(const AppRequest& request, const Ini& ini) {
    for (const char* key : {"particles_count", "init_PDF_mode", "map_file"})
        if (iniValue(ini, kSection, key).empty()) refuse(request, std::string(key) + " is missing");
    const std::string repetitions = iniValue(ini, kSection, "experimentRepetitions");
    if (!repetitions.empty() && repetitions != "1")
        refuse(request, "experimentRepetitions = " + repetitions +
                            ": must be 1: MRPT's repetitions share one reading of the log");
    if (ini.read_bool(kSection, "init_PDF_mode", true)) return;
    const bool has_grid = ini.read_int(kMapSection, "occupancyGrid_count", 0) > 0;
    if (!has_grid || ini.read_bool(kSection, "use_3D_poses", false))
        refuse(request,
               "init_PDF_mode = 0 needs an occupancyGrid in [MetricMap] and 2D poses; 1 does not");
}

std::string findMapFile(const AppRequest& request, const Ini& ini) {
    const std::string file = iniValue(ini, kSection, "map_file");
    if (std::filesystem::exists(file)) return file;
    const auto beside = std::filesystem::path(request.config).parent_path() / file;
    if (!std::filesystem::exists(beside)) refuse(request, "map_file = " + file + ": no such file");
    return beside.string();
}

void localize(const AppRequest& request) {
    Ini ini = readIni(request.config);
    for (const char* section : {kSection, kMapSection, "PF_options"})
        requireSection(ini, request.config, section);
    if (!checkMaps(ini, request.config, kMapSection))
        std::cerr << "akimap: warning: " << request.config << ": [" << kMapSection
                  << "] has no akimap_count = 1: no AkiMap is used\n";
    checkExperiment(request, ini);
    const std::string map_file = findMapFile(request, ini);
    static_cast<void>(request.checked(map_file));  // MRPT reads it
    ini.write(kSection, "map_file", map_file);
    LogFeed feed(request.checked(request.rawlog), LogFeed::Form::as_recorded,
                 0);  // it skips rawlog_offset itself
    Results results(outputFolder(request, ini, kSection));
    FedApp<mrpt::apps::MonteCarloLocalization_Rawlog> app(feed);
    quietDown(ini, kSection, request, app);
    ini.write(kSection, "logOutput_dir", results.scratch() + "/localization");
    app.allow_quit_on_esc_key = false;
    app.fill_out_estimated_path = true;
    app.params = withRegisteredMaps(ini, kMapSection);
    runApp(
        request, [&] { app.run(); }, feed, results);
    results.publish("map_", {app.out_estimated_path.begin(), app.out_estimated_path.end()});
}

}  // namespace

void addLocalize(CLI::App& app) {
    auto* command =
        app.add_subcommand("localize", "Run MRPT's particle filter localization in an AkiMap");
    const auto request = std::make_shared<AppRequest>();
    addInputs(*command, *request, "INI of pf-localization");
    addOutputs(*command, *request);
    command->footer(kFooter);
    addExamples(*command, "localize pf.ini drive.rawlog", "localize pf.ini drive.rawlog --verbose");
    command->callback([request] { localize(*request); });
}

}  // namespace akimap::app
