// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <mrpt/config/CConfigFileMemory.h>

#include <string>

namespace akimap::app {

using Ini = mrpt::config::CConfigFileMemory;

/** \exception std::runtime_error naming the file if it can't be read */
[[nodiscard]] std::string textOf(const std::string& file);

/** \param file for errors. \exception std::runtime_error naming the file if it is no INI */
[[nodiscard]] Ini parseIni(const std::string& file, const std::string& text);

/** \exception std::runtime_error naming the file if it can't be read or is no INI */
[[nodiscard]] inline Ini readIni(const std::string& file) {
    return parseIni(file, textOf(file));
}

/** The value of a key, without a comment; empty if it is missing. */
[[nodiscard]] std::string iniValue(const Ini& ini, const std::string& section,
                                   const std::string& key);

}  // namespace akimap::app
