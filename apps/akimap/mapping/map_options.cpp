// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "mapping/map_options.h"

#include <map>
#include <sstream>
#include <stdexcept>
#include <type_traits>

#include "cli.h"
#include "mapping/config.h"

namespace akimap::app {

namespace {

constexpr const char* kMapGroup = "Map (these win over the INI)";

const std::map<std::string, Estimator> kEstimators{{"surface", Estimator::surface},
                                                   {"paper", Estimator::paper}};
const std::map<std::string, Bandwidth> kBandwidths{{"adaptive", Bandwidth::adaptive},
                                                   {"covariance", Bandwidth::covariance},
                                                   {"isotropic", Bandwidth::isotropic}};

/** What the options struct itself says of one of its fields. */
OptionText describedAs(const std::string& key) {
    for (const OptionText& option : describe(TInsertionOptions()))
        if (option.key == key) return option;
    throw std::logic_error("no option " + key);
}

template <class T, class Owner>
void set(MapRequest& request, T Owner::*field, const T& value) {
    request.settings.emplace_back([field, value](AkiMap::TMapDefinition& definition) {
        definition.insertionOpts.*field = value;
    });
}

/** Adds an option for a field of the insertion options, with their comment and default. It means
 * what its key in an INI means: no option sets another one. */
template <class T, class Owner>
void addSetting(CLI::App& command, MapRequest& request, const std::string& flag,
                const std::string& key, T Owner::*field) {
    const OptionText text = describedAs(key);
    const auto take = [&request, field](const T& value) { set(request, field, value); };
    command.add_option_function<T>(flag, take, text.comment)
        ->check(std::is_unsigned_v<T> ? CLI::Validator(kWholeNumber) : CLI::Validator())
        ->default_str(text.value)
        ->group(kMapGroup);
}

/** The same for one of several names. */
template <class Enum, class Owner>
void addChoice(CLI::App& command, MapRequest& request, const std::string& flag,
               const std::string& key, const std::map<std::string, Enum>& names,
               Enum Owner::*field) {
    const OptionText text = describedAs(key);
    const auto take = [&request, &names, field](const std::string& name) {
        set(request, field, names.at(name));
    };
    command.add_option_function<std::string>(flag, take, text.comment)
        ->check(CLI::IsMember(names))
        ->type_name("NAME")
        ->default_str(text.value)
        ->group(kMapGroup);
}

}  // namespace

void addMapOptions(CLI::App& command, MapRequest& request) {
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
    addSetting(command, request, "--threads", "threads", &InsertionParameters::threads);
    addChoice(command, request, "--estimator", "estimator", kEstimators,
              &InsertionParameters::estimator);
    addChoice(command, request, "--bandwidth", "bandwidth", kBandwidths,
              &InsertionParameters::bandwidth);
    addSetting(command, request, "--isotropic-length", "isotropic_length",
               &InsertionParameters::isotropic_length);
    addSetting(command, request, "--seed", "seed", &InsertionParameters::seed);
}

AkiMap makeMapFor(const MapRequest& request) {
    AkiMap::TMapDefinition definition = request.config.empty()
                                            ? AkiMap::TMapDefinition()
                                            : loadConfig(request.config, request.section);
    for (const auto& set : request.settings) set(definition);
    AkiMap map = makeMap(definition);
    if (!map.genericMapParams.enableObservationInsertion)
        throw std::runtime_error(request.config +
                                 ": enableObservationInsertion = false leaves nothing to build");
    return map;
}

}  // namespace akimap::app
