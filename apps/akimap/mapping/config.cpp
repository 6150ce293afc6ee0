// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "mapping/config.h"

#include <mrpt/config/CConfigFileMemory.h>
#include <mrpt/system/string_utils.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "mapping/option_groups.h"

namespace akimap::app {

namespace {

using mrpt::system::trim;

std::string shortText(double value) {
    std::ostringstream text;
    text << value;
    return text.str();
}

}  // namespace

std::vector<OptionText> creationOptions(const AkiMap::TMapDefinition& definition) {
    const auto yes_no = [](bool value) { return std::string(value ? "true" : "false"); };
    const auto& generic = definition.genericMapParams;
    return {
        {"resolution", shortText(definition.resolution), "[m] > 0. Side of a cell"},
        {"enableSaveAs3DObject", yes_no(generic.enableSaveAs3DObject), "Draw the map in 3D scenes"},
        {"enableObservationLikelihood", yes_no(generic.enableObservationLikelihood),
         "Let it weigh observations in localization"},
        {"enableObservationInsertion", yes_no(generic.enableObservationInsertion),
         "Let observations change it"}};
}

std::vector<OptionGroup> optionGroups(const AkiMap::TMapDefinition& d) {
    return {{{"_creationOpts"}, "The grid, and MRPT's switches for any map", creationOptions(d)},
            {{"_insertOpts", "_insertionOpts"},
             "How scans change the map: the method and its constants",
             describe(d.insertionOpts)},
            {{"_likelihoodOpts"},
             "How likely an observation is from a pose: for localization",
             describe(d.likelihoodOpts)},
            {{"_renderOpts", "_renderingOpts"}, "How the map is drawn", describe(d.renderingOpts)}};
}

std::vector<OptionText> describe(const mrpt::config::CLoadableOptions& options) {
    mrpt::config::CConfigFileMemory ini;
    options.saveToConfigFile(ini, "options");
    std::string text;
    ini.getContent(text);
    std::istringstream lines(text);
    std::vector<OptionText> described;
    for (std::string line; std::getline(lines, line);) {
        const auto equals = line.find('='), comment = line.find(" // ");
        if (equals == std::string::npos || comment < equals) continue;
        OptionText option;
        option.key = trim(line.substr(0, equals));
        option.value = trim(line.substr(equals + 1, std::min(comment, line.size()) - equals - 1));
        if (comment != std::string::npos) option.comment = trim(line.substr(comment + 4));
        described.push_back(option);
    }
    return described;
}

std::string defaultConfig() {
    const std::string section = "MappingApplication";
    std::ostringstream out;
    out << "# An AkiMap in a multi-metric map, with every option at its default.\n"
           "# For akimap build -c, observations2map, icp-slam and any MRPT program that reads\n"
           "# metric maps from an INI file; sections of further maps may stand beside these.\n"
           "# Lengths are in metres.\n\n["
        << section << "]\nakimap_count = 1\n";
    for (const OptionGroup& group : optionGroups({})) {
        out << "\n# " << group.title << "\n[" << sectionPrefix(section) << group.suffixes.front()
            << "]\n";
        std::size_t width = 0;
        for (const OptionText& o : group.options)
            width = std::max(width, o.key.size() + 3 + o.value.size());
        for (const OptionText& o : group.options) {
            const std::string setting = o.key + " = " + o.value;
            out << setting << std::string(width - setting.size() + 2, ' ') << "// " << o.comment
                << "\n";
        }
    }
    return out.str();
}

AkiMap makeMap(const AkiMap::TMapDefinition& definition) {
    if (!(std::isfinite(definition.resolution) && definition.resolution > 0))
        throw std::invalid_argument("resolution = " + shortText(definition.resolution) +
                                    ": must be finite and > 0");
    definition.insertionOpts.validate();
    AkiMap map(definition.resolution);
    map.genericMapParams = definition.genericMapParams;
    map.insertionOptions = definition.insertionOpts;
    map.likelihoodOptions = definition.likelihoodOpts;
    map.renderingOptions = definition.renderingOpts;
    // An insertion of nothing refuses settings that don't fit together, before there is work to
    // lose. On a copy and one thread: the map's own times must start at zero, threads included.
    AkiMap probe(map);
    probe.insertionOptions.threads = 1;
    probe.insertRays({});
    return map;
}

}  // namespace akimap::app
