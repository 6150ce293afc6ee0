// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "mapping/config.h"

#include <mrpt/config/CConfigFileMemory.h>
#include <mrpt/system/string_utils.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <sstream>
#include <stdexcept>

#include "errors.h"
#include "input/files.h"
#include "input/numbers.h"

namespace akimap::app {

namespace {

using mrpt::config::CConfigFileMemory;
using mrpt::system::lowerCase;
using mrpt::system::trim;
using Definition = AkiMap::TMapDefinition;

/** The options of one group of INI sections and the names these may have. */
struct Group {
    std::vector<std::string> suffixes;  // of the section's name; the first is the one written
    std::string title;
    std::vector<OptionText> options;
};

std::string shortText(double value) {
    std::ostringstream text;
    text << value;
    return text.str();
}

std::vector<OptionText> creationOptions(const Definition& definition) {
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

std::vector<Group> groupsOf(const Definition& d) {
    return {{{"_creationOpts"}, "The grid, and MRPT's switches for any map", creationOptions(d)},
            {{"_insertOpts", "_insertionOpts"},
             "How scans change the map: the method and its constants",
             describe(d.insertionOpts)},
            {{"_likelihoodOpts"},
             "How likely an observation is from a pose: for localization",
             describe(d.likelihoodOpts)},
            {{"_renderOpts", "_renderingOpts"}, "How the map is drawn", describe(d.renderingOpts)}};
}

std::string prefixOf(const std::string& section) {
    return section + "_akimap_00";
}

/** A strict reading of one INI file. Names are compared as MRPT does, whatever their case. */
class Reader {
 public:
    Reader(const std::string& file, const std::string& section) : file_(file), section_(section) {
        requireReadable(file);
        std::ifstream in(file, std::ios::binary);
        const std::string text{std::istreambuf_iterator<char>(in), {}};
        try {
            ini_.setContent(text);
        } catch (const std::exception& e) {
            refuse(reasonOf(e.what()));
        }
        ini_.getAllSections(sections_);
        checkLines(text);
    }

    Definition load() {
        Definition definition;
        const std::vector<Group> groups = groupsOf(definition);
        checkSections(groups);
        checkCount();
        for (const Group& group : groups) checkKeys(group);
        cleanCreation();
        try {
            definition.loadFromConfigFile(ini_, prefixOf(section_));
        } catch (const std::exception& e) {  // names the key and its value
            refuse(reasonOf(e.what()));
        }
        return definition;
    }

 private:
    [[noreturn]] void refuse(const std::string& what) const {
        throw std::runtime_error(file_ + ": " + what);
    }

    /** What MRPT's parser passes over without a word, in the sections of the map. */
    void checkLines(const std::string& text) const {
        std::istringstream lines(text);
        std::string section;
        std::set<std::string> keys;
        int number = 0;
        for (std::string line; std::getline(lines, line);) {
            number++;
            line = trim(line.substr(0, std::min(line.find_first_of(";#\r"), line.find("//"))));
            const auto at = [&] { return "line " + std::to_string(number) + ", '" + line + "': "; };
            if (!line.empty() && line[0] == '[') section = lowerCase(line), keys.clear();
            if (line.empty() || line[0] == '[' || section.find("akimap") == std::string::npos)
                continue;
            if (line.find('=') == std::string::npos) refuse(at() + "not KEY = VALUE");
            if (!keys.insert(lowerCase(trim(line.substr(0, line.find('='))))).second)
                refuse(at() + "the second value of this key");
        }
    }

    /** The value of a key without a comment behind it. */
    std::string value(const std::string& section, const std::string& key) const {
        const std::string text = ini_.read_string(section, key, "");
        return trim(text.substr(0, std::min(text.find_first_of(";#"), text.find("//"))));
    }

    bool isKnown(const std::string& name, const std::vector<Group>& groups) const {
        for (const Group& group : groups)
            for (const std::string& suffix : group.suffixes)
                if (lowerCase(name) == lowerCase(prefixOf(section_) + suffix)) return true;
        return lowerCase(name) == lowerCase(section_);
    }

    void checkSections(const std::vector<Group>& groups) const {
        for (const std::string& name : sections_)
            if (lowerCase(name).find("akimap") != std::string::npos && !isKnown(name, groups))
                refuse("unknown section [" + name + "]; those of the map begin with [" +
                       prefixOf(section_) + "_");
        for (const Group& group : groups)
            if (group.suffixes.size() > 1 && ini_.sectionExists(fullName(group, 0)) &&
                ini_.sectionExists(fullName(group, 1)))
                refuse("both [" + fullName(group, 0) + "] and [" + fullName(group, 1) +
                       "]; they mean the same");
    }

    std::string fullName(const Group& group, std::size_t i) const {
        return prefixOf(section_) + group.suffixes[i];
    }

    void checkCount() const {
        std::vector<std::string> keys;
        ini_.getAllKeys(section_, keys);
        for (const std::string& key : keys)
            if (lowerCase(key).find("akimap") != std::string::npos &&
                lowerCase(key) != "akimap_count")
                refuse("[" + section_ + "] unknown key " + key);
        if (!ini_.keyExists(section_, "akimap_count"))
            refuse("no akimap section: [" + section_ + "] has no akimap_count = 1");
        const std::string count = value(section_, "akimap_count");
        if (count != "1") refuse("[" + section_ + "] akimap_count = " + count + ": must be 1");
    }

    void checkKeys(const Group& group) const {
        for (std::size_t i = 0; i < group.suffixes.size(); i++) {
            const std::string name = fullName(group, i);
            if (!ini_.sectionExists(name)) continue;
            std::vector<std::string> keys;
            ini_.getAllKeys(name, keys);
            for (const std::string& key : keys) {
                const auto is_it = [&](const OptionText& option) {
                    return lowerCase(option.key) == lowerCase(key);
                };
                if (std::none_of(group.options.begin(), group.options.end(), is_it))
                    refuse("[" + name + "] unknown key " + key);
            }
        }
    }

    /** MRPT reads these itself, takes any text for a number, and "true ; why" for false. */
    void cleanCreation() {
        const std::string section = prefixOf(section_) + "_creationOpts";
        for (const OptionText& option : creationOptions({})) {
            if (!ini_.keyExists(section, option.key)) continue;
            const std::string text = value(section, option.key), lower = lowerCase(text);
            const auto want = [&](bool ok, const char* what) {
                if (!ok)
                    refuse("[" + section + "] " + option.key + " = " + text + ": must be " + what);
            };
            double number = 0;
            if (option.key == "resolution")
                want(parseNumber(std::string_view(text), number) && number > 0 &&
                         std::isfinite(number),
                     "a finite number > 0");
            else
                want(lower == "true" || lower == "false" || lower == "yes" || lower == "no" ||
                         lower == "1" || lower == "0",
                     "true or false");
            ini_.write(section, option.key, text);
        }
    }

    std::string file_, section_;
    CConfigFileMemory ini_;
    std::vector<std::string> sections_;
};

}  // namespace

std::vector<OptionText> describe(const mrpt::config::CLoadableOptions& options) {
    CConfigFileMemory ini;
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

AkiMap::TMapDefinition loadConfig(const std::string& file, const std::string& section) {
    return Reader(file, section).load();
}

std::string defaultConfig() {
    const std::string section = "MappingApplication";
    std::ostringstream out;
    out << "# An AkiMap in a multi-metric map, with every option at its default.\n"
           "# For akimap build -c, observations2map, icp-slam and any MRPT program that reads\n"
           "# metric maps from an INI file; sections of further maps may stand beside these.\n"
           "# Lengths are in metres.\n\n["
        << section << "]\nakimap_count = 1\n";
    for (const Group& group : groupsOf({})) {
        out << "\n# " << group.title << "\n[" << prefixOf(section) << group.suffixes.front()
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
