// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <akimap/AkiMap.h>
#include <mrpt/config/CConfigFileBase.h>
#include <mrpt/maps/TMetricMapTypesRegistry.h>
#include <mrpt/rtti/CObject.h>
#include <mrpt/system/string_utils.h>

#include <algorithm>
#include <iostream>
#include <mutex>
#include <set>

#include "mrpt/mrpt_compat.h"
#include "mrpt/option_fields.h"
#include "support/similar.h"

MAP_DEFINITION_REGISTER("akimap::AkiMap,akimap", akimap::AkiMap)
IMPLEMENTS_SERIALIZABLE(AkiMap, mrpt::maps::CMetricMap, akimap)

namespace akimap {
namespace {

/** MRPT's programs tell nobody of a key that they do not know; a mistyped option must not pass
 * unseen. Names are compared as MRPT does, whatever their case. */
void warnOfUnknownKeys(const mrpt::config::CConfigFileBase& source, const std::string& section,
                       const std::vector<std::string>& known) {
    std::vector<std::string> keys;
    source.getAllKeys(section, keys);
    for (const std::string& key : keys) {
        const auto is_it = [&](const std::string& name) {
            return mrpt::system::strCmpI(name, key);
        };
        if (std::none_of(known.begin(), known.end(), is_it))
            std::cerr << "akimap: warning: [" << section << "] unknown key " << key
                      << didYouMean(key, known) << "\n";
    }
}

/** Nor of a section that is no map's. Only of names almost like ours: others may be those of
 * another program or of another of several maps. */
void warnOfMistypedSections(const mrpt::config::CConfigFileBase& source,
                            const std::string& prefix) {
    const auto mapNumber = [](const std::string& name) {  // "_00_" of "map_akimap_00_insertOpts"
        const auto end = name.rfind('_');
        return end == std::string::npos || end < 3 ? name : name.substr(end - 3, 4);
    };
    std::vector<std::string> ours, names;
    for (const char* suffix : {"_creationOpts", "_insertOpts", "_insertionOpts", "_likelihoodOpts",
                               "_renderOpts", "_renderingOpts"})
        ours.push_back(prefix + suffix);
    source.getAllSections(names);
    for (const std::string& name : names) {
        const std::string meant = similarTo(name, ours);
        if (meant.empty() || mrpt::system::strCmpI(meant, name) ||
            mapNumber(meant) != mapNumber(name))
            continue;
        std::cerr << "akimap: warning: unknown section [" << name << "]; did you mean [" << meant
                  << "]?\n";
    }
}

/** Neither do they tell of an option that changes nothing. Once for each, as particle filters make
 * many maps. */
void warnOfIdleOptions(const InsertionParameters& p) {
    static std::mutex one_at_a_time;
    static std::set<std::string> told;
    const std::lock_guard lock(one_at_a_time);
    p.validate();
    const char* estimator = enumNames(p.estimator)[static_cast<std::size_t>(p.estimator)];
    for (const std::string& name : idleOptions(p))
        if (told.insert(name).second)
            std::cerr << "akimap: warning: " << name
                      << " changes nothing: estimator = " << estimator << " does not use it\n";
}

template <class Parameters>
void load(LoadableOptions<Parameters>& options, const mrpt::config::CConfigFileBase& source,
          const std::string& section) {
    std::vector<std::string> known;
    visitFields(options, [&](const char* name, auto&, const char*) { known.emplace_back(name); });
    warnOfUnknownKeys(source, section, known);
    options.loadFromConfigFile(source, section);
}

}  // namespace

AkiMap::TMapDefinition::TMapDefinition() = default;

void AkiMap::TMapDefinition::loadFromConfigFile_map_specific(
    const mrpt::config::CConfigFileBase& source, const std::string& prefix) {
    warnOfMistypedSections(source, prefix);
    warnOfUnknownKeys(source, prefix + "_creationOpts",
                      {"resolution", "enableSaveAs3DObject", "enableObservationInsertion",
                       "enableObservationLikelihood"});
    readOption(source, prefix + "_creationOpts", "resolution", resolution);
    load(insertionOpts, source, prefix + "_insertOpts");
    load(insertionOpts, source, prefix + "_insertionOpts");
    load(likelihoodOpts, source, prefix + "_likelihoodOpts");
    load(renderingOpts, source, prefix + "_renderOpts");
    load(renderingOpts, source, prefix + "_renderingOpts");
}

void AkiMap::TMapDefinition::dumpToTextStream_map_specific(std::ostream& out) const {
    LOADABLEOPTS_DUMP_VAR(resolution, double);
    insertionOpts.dumpToTextStream(out);
    likelihoodOpts.dumpToTextStream(out);
    renderingOpts.dumpToTextStream(out);
}

AKIMAP_NEW_MAP_RESULT AkiMap::internal_CreateFromMapDefinition(
    const mrpt::maps::TMetricMapInitializer& def) {
    const auto& d = dynamic_cast<const AkiMap::TMapDefinition&>(def);
    auto map = AKIMAP_NEW_MAP(d.resolution);
    warnOfIdleOptions(d.insertionOpts);
    map->insertionOptions = d.insertionOpts;
    map->likelihoodOptions = d.likelihoodOpts;
    map->renderingOptions = d.renderingOpts;
    return map;
}

namespace {

/** MRPT also registers each class without its namespace, and reads INI keys without regard to
 * case: to it `akimap_count = 1` would ask for one map named akimap and for one named AkiMap. */
void keepOneIniName() {
    auto& registry = mrpt::maps::internal::TMetricMapTypesRegistry::Instance();
    using Names =
        std::remove_const_t<std::remove_reference_t<decltype(registry.getAllRegistered())>>;
    const_cast<Names&>(registry.getAllRegistered()).erase("AkiMap");
}

}  // namespace

void registerClasses() {
    static const bool once = [] {
        mrpt::rtti::registerClass(CLASS_ID(AkiMap));
        keepOneIniName();
        return true;
    }();
    static_cast<void>(once);
}

}  // namespace akimap

namespace {
// On load, and not by MRPT_INITIALIZER: that may run before MAP_DEFINITION_REGISTER above.
const bool registered_on_load = (akimap::registerClasses(), true);
}  // namespace
