// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>

// Checks of options: each throws std::invalid_argument that names the option and its value.

namespace akimap {

[[noreturn]] inline void reject(const std::string& name, const std::string& value,
                                const std::string& want) {
    throw std::invalid_argument(name + " = " + value + ": must be " + want);
}
inline void require(bool ok, const char* name, double value, const char* want) {
    if (ok) return;
    char text[32];
    std::snprintf(text, sizeof text, "%g", value);
    reject(name, text, want);
}
inline void requirePositive(const char* name, double v) {
    require(std::isfinite(v) && v > 0, name, v, "finite and > 0");
}
inline void requireNonNegative(const char* name, double v) {
    require(std::isfinite(v) && v >= 0, name, v, "finite and >= 0");
}
inline void requireProbability(const char* name, double v) {
    require(v > 0 && v < 1, name, v, "between 0 and 1");
}
/** Of an enumeration whose values count from 0 and have names: see enumNames(). */
template <class Enum>
void requireNamed(const char* name, Enum v) {
    require(static_cast<std::size_t>(v) < enumNames(v).size(), name, static_cast<double>(v),
            "one of its named values");
}

}  // namespace akimap
