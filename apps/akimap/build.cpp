// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <map>
#include <memory>
#include <sstream>

#include "build_map.h"
#include "cli.h"
#include "commands.h"
#include "config.h"

namespace akimap::app {

namespace {

constexpr const char* kMapGroup = "Map (these win over the INI)";
constexpr const char* kInputGroup = "Input";
constexpr const char* kOutputGroup = "Output";

const std::map<std::string, Bandwidth> kBandwidths{{"adaptive", Bandwidth::adaptive},
                                                   {"covariance", Bandwidth::covariance},
                                                   {"isotropic", Bandwidth::isotropic}};

/** What the options struct itself says of one of its fields. */
OptionText describedAs(const std::string& key) {
    for (const OptionText& option : describe(TInsertionOptions()))
        if (option.key == key) return option;
    throw std::logic_error("no option " + key);
}

/** Adds an option for a field of the insertion options, with their comment and default. */
template <class T>
void addSetting(CLI::App& command, BuildRequest& request, const std::string& flag,
                const std::string& key, T InsertionParameters::*field) {
    const OptionText text = describedAs(key);
    const auto set = [&request, field](const T& value) {
        request.settings.emplace_back([field, value](AkiMap::TMapDefinition& definition) {
            definition.insertionOpts.*field = value;
        });
    };
    command.add_option_function<T>(flag, set, text.comment)
        ->check(std::is_unsigned_v<T> ? CLI::Validator(kWholeNumber) : CLI::Validator())
        ->default_str(text.value)
        ->group(kMapGroup);
}

void addMapOptions(CLI::App& command, BuildRequest& request) {
    command.add_option("-c,--config", request.config, "INI file with the map's options")
        ->group(kMapGroup);
    command
        .add_option("--section", request.section, "Section of the INI that has akimap_count = 1")
        ->needs("--config")
        ->group(kMapGroup);
    const auto set_resolution = [&request](const double& value) {
        request.settings.emplace_back(
            [value](AkiMap::TMapDefinition& definition) { definition.resolution = value; });
    };
    std::ostringstream resolution;
    resolution << AkiMap::TMapDefinition().resolution;
    command.add_option_function<double>("--resolution", set_resolution, "[m] > 0. Side of a cell")
        ->default_str(resolution.str())
        ->group(kMapGroup);
    addSetting(command, request, "--max-range", "max_range", &InsertionParameters::max_range);
    addSetting(command, request, "--min-range", "min_range", &InsertionParameters::min_range);
    addSetting(command, request, "--isotropic-length", "isotropic_length",
               &InsertionParameters::isotropic_length);
    addSetting(command, request, "--seed", "seed", &InsertionParameters::seed);
    addSetting(command, request, "--threads", "threads", &InsertionParameters::threads);

    const OptionText bandwidth = describedAs("bandwidth");
    const auto set_bandwidth = [&request](const std::string& name) {
        request.settings.emplace_back([value = kBandwidths.at(name)](auto& definition) {
            definition.insertionOpts.bandwidth = value;
        });
    };
    command.add_option_function<std::string>("--bandwidth", set_bandwidth, bandwidth.comment)
        ->check(CLI::IsMember(kBandwidths))
        ->type_name("NAME")
        ->default_str(bandwidth.value)
        ->group(kMapGroup);
}

void addInputOptions(CLI::App& command, BuildRequest& request) {
    command
        .add_option("INPUT", request.inputs,
                    ".rawlog, .simplemap or .pcd files (points in the map frame), taken in turn")
        ->default_str("")
        ->required();
    const auto add = [&](const char* flag, auto& value, const char* help) {
        return command.add_option(flag, value, help)->group(kInputGroup);
    };
    add("--trajectory", request.trajectory,
        "TUM file of the robot's poses in the map, for the rawlogs [default: their own poses, "
        "else odometry]");
    add("--max-gap", request.max_gap, "[s] > 0. Largest gap bridged between robot poses");
    add("--only", request.only_label, "Take only observations with this sensor label")
        ->type_name("LABEL");
    add("--first", request.first, "Take only the first so many scans; 0: all")->check(kWholeNumber);
    command
        .add_flag("--partial", request.partial,
                  "Of a rawlog cut in its last object, take what is whole")
        ->group(kInputGroup);
    auto* follow = command.add_flag("--follow", request.follow,
                                    "The last INPUT is a rawlog that is still being written: map "
                                    "it as it grows, until --idle or ^C, then write the map");
    follow->group(kInputGroup);
    add("--idle", request.idle, "[s] > 0. A followed rawlog ends when it has not grown so long")
        ->needs(follow);
}

void addOutputOptions(CLI::App& command, BuildRequest& request) {
    command.add_option("-o,--output", request.output, "The map to write (.akimap)")
        ->required()
        ->group(kOutputGroup);
    command
        .add_option("--export", request.exports,
                    "Write the map as .csv, .ply, .pcd, .bt, .ot, .3Dscene or .png too; repeatable")
        ->allow_extra_args(false)
        ->default_str("")
        ->group(kOutputGroup);
    command.add_option("--json", request.json, "Write counts, times [s] and memory [bytes]")
        ->group(kOutputGroup);
    command.add_flag("--quiet", request.quiet, "No progress bar and no table")->group(kOutputGroup);
}

}  // namespace

void addBuild(CLI::App& app) {
    auto* command = app.add_subcommand("build", "Build a map from logs and point clouds");
    const auto request = std::make_shared<BuildRequest>();
    addInputOptions(*command, *request);
    addMapOptions(*command, *request);
    addOutputOptions(*command, *request);
    command->callback([request] { buildMap(*request); });
}

}  // namespace akimap::app
