// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <mrpt/system/string_utils.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>
#include <stdexcept>

#include "errors.h"
#include "input/ini.h"
#include "input/numbers.h"
#include "mapping/option_groups.h"
#include "support/ini.h"
#include "support/similar.h"

namespace akimap::app {

namespace {

using mrpt::system::lowerCase;
using mrpt::system::trim;

/** A strict reading of one INI file. Names are compared as MRPT does, whatever their case. */
class ConfigReader {
 public:
    ConfigReader(const std::string& file, const std::string& section)
        : file_(file), section_(section) {
        const std::string text = textOf(file);
        ini_ = parseIni(file, text);
        ini_.getAllSections(sections_);
        checkLines(text);
    }

    AkiMap::TMapDefinition load() {
        AkiMap::TMapDefinition definition;
        const std::vector<OptionGroup> groups = optionGroups(definition);
        checkSections(groups);
        checkCount();
        for (const OptionGroup& group : groups) checkKeys(group);
        cleanCreation();
        try {
            definition.loadFromConfigFile(ini_, sectionPrefix(section_));
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
            line = withoutComment(line);
            const auto at = [&] { return "line " + std::to_string(number) + ", '" + line + "': "; };
            if (!line.empty() && line[0] == '[') section = lowerCase(line), keys.clear();
            if (line.empty() || line[0] == '[' || section.find("akimap") == std::string::npos)
                continue;
            if (line.find('=') == std::string::npos) refuse(at() + "not KEY = VALUE");
            if (!keys.insert(lowerCase(trim(line.substr(0, line.find('='))))).second)
                refuse(at() + "the second value of this key");
        }
    }

    bool isKnown(const std::string& name, const std::vector<OptionGroup>& groups) const {
        for (const OptionGroup& group : groups)
            for (const std::string& suffix : group.suffixes)
                if (lowerCase(name) == lowerCase(sectionPrefix(section_) + suffix)) return true;
        return lowerCase(name) == lowerCase(section_);
    }

    void checkSections(const std::vector<OptionGroup>& groups) const {
        for (const std::string& name : sections_)
            if (lowerCase(name).find("akimap") != std::string::npos && !isKnown(name, groups))
                refuse("unknown section [" + name + "]" + meantSection(name, groups));
        for (const OptionGroup& group : groups)
            if (group.suffixes.size() > 1 && ini_.sectionExists(fullName(group, 0)) &&
                ini_.sectionExists(fullName(group, 1)))
                refuse("both [" + fullName(group, 0) + "] and [" + fullName(group, 1) +
                       "]; they mean the same");
    }

    std::string meantSection(const std::string& name,
                             const std::vector<OptionGroup>& groups) const {
        std::vector<std::string> names;
        for (const OptionGroup& group : groups)
            for (std::size_t i = 0; i < group.suffixes.size(); i++)
                names.push_back(fullName(group, i));
        const std::string meant = similarTo(name, names);
        if (!meant.empty()) return "; did you mean [" + meant + "]?";
        return "; those of the map begin with [" + sectionPrefix(section_) + "_";
    }

    std::string fullName(const OptionGroup& group, std::size_t i) const {
        return sectionPrefix(section_) + group.suffixes[i];
    }

    void checkCount() const {
        std::vector<std::string> keys;
        ini_.getAllKeys(section_, keys);
        for (const std::string& key : keys)
            if (lowerCase(key).find("akimap") != std::string::npos &&
                lowerCase(key) != "akimap_count")
                refuse("[" + section_ + "] unknown key " + key + didYouMean(key, {"akimap_count"}));
        if (!ini_.keyExists(section_, "akimap_count"))
            refuse("no akimap section: [" + section_ + "] has no akimap_count = 1");
        const std::string count = iniValue(ini_, section_, "akimap_count");
        if (count != "1") refuse("[" + section_ + "] akimap_count = " + count + ": must be 1");
    }

    void checkKeys(const OptionGroup& group) const {
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
                    refuse("[" + name + "] unknown key " + key + meantKey(key, group));
            }
        }
    }

    static std::string meantKey(const std::string& key, const OptionGroup& group) {
        std::vector<std::string> keys;
        for (const OptionText& option : group.options) keys.push_back(option.key);
        return didYouMean(key, keys);
    }

    /** MRPT reads these itself, takes any text for a number, and "true ; why" for false. */
    void cleanCreation() {
        const std::string section = sectionPrefix(section_) + "_creationOpts";
        for (const OptionText& option : creationOptions({})) {
            if (!ini_.keyExists(section, option.key)) continue;
            const std::string text = iniValue(ini_, section, option.key), lower = lowerCase(text);
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
    Ini ini_;
    std::vector<std::string> sections_;
};

}  // namespace

AkiMap::TMapDefinition loadConfig(const std::string& file, const std::string& section) {
    return ConfigReader(file, section).load();
}

}  // namespace akimap::app
