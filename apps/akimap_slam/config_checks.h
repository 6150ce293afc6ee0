// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <string>

#include "input/ini.h"

namespace akimap::app {

/** \exception std::runtime_error naming the file and the section */
void requireSection(const Ini& ini, const std::string& file, const std::string& section);

/** Refuses what MRPT 2.5 ignores: a `<name>_count` > 0 of a map that it does not know, whatever
 * the case of its letters. An AkiMap's own sections are checked too; \return whether there is one.
 * \exception std::runtime_error naming the file, the section and the key */
bool checkMaps(const Ini& ini, const std::string& file, const std::string& section);

/** The same with each `<name>_count` of the section spelled as MRPT registered the name, and none
 * of maps that it does not know: from 2.11.3 on MRPT refuses those even if they are 0. */
[[nodiscard]] Ini withRegisteredMaps(const Ini& ini, const std::string& section);

}  // namespace akimap::app
