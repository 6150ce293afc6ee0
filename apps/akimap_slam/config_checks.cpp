// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "config_checks.h"

#include <mrpt/maps/TMetricMapTypesRegistry.h>
#include <mrpt/system/string_utils.h>

#include <cstdlib>
#include <iterator>
#include <set>

#include "config.h"
#include "errors.h"
#include "input/files.h"

namespace akimap::app {

using mrpt::system::lowerCase;

Ini readIni(const std::string& file) {
    requireReadable(file);
    std::ifstream in(file, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    Ini ini;
    try {
        ini.setContent(text);
    } catch (const std::exception& e) {
        throw std::runtime_error(file + ": " + reasonOf(e.what()));
    }
    return ini;
}

void requireSection(const Ini& ini, const std::string& file, const std::string& section) {
    if (!ini.sectionExists(section))
        throw std::runtime_error(file + ": no section [" + section + "]");
}

std::string iniValue(const Ini& ini, const std::string& section, const std::string& key) {
    const std::string text = ini.read_string(section, key, "");
    return mrpt::system::trim(text.substr(0, std::min(text.find_first_of(";#"), text.find("//"))));
}

bool checkMaps(const Ini& ini, const std::string& file, const std::string& section) {
    std::set<std::string> known;
    std::string names;
    const auto& registry = mrpt::maps::internal::TMetricMapTypesRegistry::Instance();
    for (const auto& entry : registry.getAllRegistered()) {
        known.insert(lowerCase(entry.first));
        // MRPT knows each map by the name of its class too, which nobody writes into an INI.
        const bool is_class = entry.first.find("::") != std::string::npos || entry.first[0] == 'C';
        if (!is_class) names += (names.empty() ? "" : ", ") + entry.first;
    }
    const std::string suffix = "_count";
    bool has_akimap = false;
    std::vector<std::string> keys;
    ini.getAllKeys(section, keys);
    for (const std::string& key : keys) {
        if (key.size() <= suffix.size()) continue;
        const auto split = key.size() - suffix.size();
        const std::string name = lowerCase(key.substr(0, split));
        if (lowerCase(key.substr(split)) != suffix) continue;
        const std::string count = iniValue(ini, section, key);
        if (std::atol(count.c_str()) <= 0) continue;
        if (known.count(name) == 0)
            throw std::runtime_error(file + ": [" + section + "] " + key + " = " + count +
                                     ": there is no such map; those that are: " + names);
        has_akimap |= name == "akimap";
    }
    if (has_akimap) static_cast<void>(loadConfig(file, section));  // refuses unknown keys
    return has_akimap;
}

}  // namespace akimap::app
