// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <akimap/AkiMap.h>

#include <string>
#include <vector>

namespace akimap::app {

/** An option as its own struct describes it. */
struct OptionText {
    std::string key, value, comment;
};

/** All options of the struct, in its order: their INI keys, present values and comments. */
[[nodiscard]] std::vector<OptionText> describe(const mrpt::config::CLoadableOptions& options);

/** Reads `[<section>_akimap_00_...]` of an INI for multi-metric maps; what it doesn't say keeps
 * its default. Sections of other maps are not looked at.
 * \exception std::runtime_error naming the file and the section or key: no such file, no akimap
 *  section, akimap_count other than 1, an unknown key, an unknown section that names akimap, or
 *  a wrong value */
[[nodiscard]] AkiMap::TMapDefinition loadConfig(const std::string& file,
                                                const std::string& section);

/** The INI that says what is the default anyway, with comments: the shipped akimap.ini. */
[[nodiscard]] std::string defaultConfig();

/** An empty map as defined. \exception std::invalid_argument naming the parameter */
[[nodiscard]] AkiMap makeMap(const AkiMap::TMapDefinition& definition);

}  // namespace akimap::app
