// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "config_checks.h"

#include <mrpt/maps/TMetricMapTypesRegistry.h>
#include <mrpt/system/string_utils.h>

#include <cstdlib>
#include <map>

#include "mapping/config.h"
#include "support/ini.h"

namespace akimap::app {

using mrpt::system::lowerCase;

namespace {

const std::string kSuffix = "_count";

/** The name in a key `<name>_count`, in lower case; empty if it is another key. */
std::string countedName(const std::string& key) {
    if (key.size() <= kSuffix.size()) return {};
    const auto split = key.size() - kSuffix.size();
    return lowerCase(key.substr(split)) == kSuffix ? lowerCase(key.substr(0, split)) : "";
}

/** Of all maps that there are, by its lower case. */
std::map<std::string, std::string> registeredNames() {
    std::map<std::string, std::string> names;
    const auto& registry = mrpt::maps::internal::TMetricMapTypesRegistry::Instance();
    for (const auto& entry : registry.getAllRegistered())
        names[lowerCase(entry.first)] = entry.first;
    return names;
}

/** For a message. MRPT knows each map by the name of its class too, which nobody writes. */
std::string listed(const std::map<std::string, std::string>& registered) {
    std::string names;
    for (const auto& [lower, name] : registered)
        if (name.find("::") == std::string::npos && name[0] != 'C')
            names += (names.empty() ? "" : ", ") + name;
    return names;
}

std::vector<std::string> keysOf(const Ini& ini, const std::string& section) {
    std::vector<std::string> keys;
    ini.getAllKeys(section, keys);
    return keys;
}

}  // namespace

void requireSection(const Ini& ini, const std::string& file, const std::string& section) {
    if (!ini.sectionExists(section))
        throw std::runtime_error(file + ": no section [" + section + "]");
}

bool checkMaps(const Ini& ini, const std::string& file, const std::string& section) {
    const auto known = registeredNames();
    bool has_akimap = false;
    for (const std::string& key : keysOf(ini, section)) {
        const std::string name = countedName(key);
        if (name.empty()) continue;
        const std::string count = iniValue(ini, section, key);
        if (std::atol(count.c_str()) <= 0) continue;
        if (known.count(name) == 0)
            throw std::runtime_error(file + ": [" + section + "] " + key + " = " + count +
                                     ": there is no such map; those that are: " + listed(known));
        has_akimap |= name == "akimap";
    }
    if (has_akimap) static_cast<void>(loadConfig(file, section));  // refuses unknown keys
    return has_akimap;
}

Ini withRegisteredMaps(const Ini& ini, const std::string& section) {
    const auto known = registeredNames();
    Ini all;
    std::vector<std::string> sections;
    ini.getAllSections(sections);
    for (const std::string& s : sections)
        for (const std::string& key : keysOf(ini, s)) {
            const std::string name = lowerCase(s) == lowerCase(section) ? countedName(key) : "";
            const auto map = known.find(name);
            if (!name.empty() && map == known.end()) continue;
            all.write(s, name.empty() ? key : map->second + kSuffix, ini.read_string(s, key, ""));
        }
    return all;
}

}  // namespace akimap::app
