// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <string>
#include <vector>

#include "mapping/config.h"

namespace akimap::app {

/** The options of one kind of section of a map's INI. */
struct OptionGroup {
    std::vector<std::string> suffixes;  ///< names of the section; the first is the one written
    std::string title;
    std::vector<OptionText> options;
};

/** All groups, in the order in which they are written, with the definition's values. */
[[nodiscard]] std::vector<OptionGroup> optionGroups(const AkiMap::TMapDefinition& definition);

/** Those of the first group. */
[[nodiscard]] std::vector<OptionText> creationOptions(const AkiMap::TMapDefinition& definition);

/** What the names of a map's sections begin with. */
[[nodiscard]] inline std::string sectionPrefix(const std::string& section) {
    return section + "_akimap_00";
}

}  // namespace akimap::app
