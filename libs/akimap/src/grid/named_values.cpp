// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "grid/named_values.h"

#include "grid/sections.h"

namespace akimap {
namespace {

constexpr const char* kEquals = " = ";

}  // namespace

std::string lineOf(const NamedValue& v) {
    return (v.required ? "!" : "") + v.name + kEquals + v.value + "\n";
}

NamedValues::NamedValues(std::string section, const std::string& text)
    : section_(std::move(section)) {
    for (std::size_t begin = 0; begin < text.size();) {
        const auto end = text.find('\n', begin), equals = text.find(kEquals, begin);
        const bool required = text[begin] == '!';
        const auto name = begin + required;
        if (end == std::string::npos || equals >= end || equals <= name)
            throw CorruptMap("section " + section_ + " has a line that is not name = value");
        const Line line{text.substr(equals + 3, end - equals - 3), required};
        const auto [at, is_new] = lines_.emplace(text.substr(name, equals - name), line);
        if (!is_new) throw CorruptMap("section " + section_ + " has " + at->first + " twice");
        begin = end + 1;
    }
}

const std::string* NamedValues::take(const std::string& name) {
    const auto line = lines_.find(name);
    if (line == lines_.end()) return nullptr;
    line->second.taken = true;
    return &line->second.value;
}

void NamedValues::requireNoneLeft() const {
    for (const auto& [name, line] : lines_)
        if (line.required && !line.taken)
            throw CorruptMap("option " + name + " of section " + section_ +
                             " is not known to this version, and is required");
}

}  // namespace akimap
