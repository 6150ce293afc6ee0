// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "input/ini.h"

#include <iterator>

#include "errors.h"
#include "input/files.h"
#include "support/ini.h"

namespace akimap::app {

std::string textOf(const std::string& file) {
    requireReadable(file);
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

Ini parseIni(const std::string& file, const std::string& text) {
    Ini ini;
    try {
        ini.setContent(text);
    } catch (const std::exception& e) {
        throw std::runtime_error(file + ": " + reasonOf(e.what()));
    }
    return ini;
}

std::string iniValue(const Ini& ini, const std::string& section, const std::string& key) {
    return withoutComment(ini.read_string(section, key, ""));
}

}  // namespace akimap::app
