// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <akimap/Options.h>
#include <mrpt/config/CConfigFileBase.h>

#include <algorithm>
#include <stdexcept>
#include <string_view>

#include "grid/named_values.h"
#include "grid/sections.h"
#include "mrpt/option_fields.h"
#include "support/ini.h"
#include "support/numbers.h"
#include "support/require.h"

namespace akimap {
namespace {

/** In the C locale, whatever the program's is. */
template <class Number>
std::enable_if_t<std::is_arithmetic_v<Number>> parse(const std::string& name,
                                                     const std::string& text, Number& value) {
    if (!parseNumber(text, value))
        reject(name, "'" + text + "'",
               std::is_integral_v<Number> ? "a whole number >= 0, and not too large" : "a number");
}
void parse(const std::string& name, const std::string& text, bool& value) {
    if (text != "true" && text != "false" && text != "1" && text != "0")
        reject(name, "'" + text + "'", "true or false");
    value = text == "true" || text == "1";
}
template <class Enum>
std::enable_if_t<std::is_enum_v<Enum>> parse(const std::string& name, const std::string& text,
                                             Enum& value) {
    constexpr auto known = enumNames(Enum{});
    const auto at = std::find(known.begin(), known.end(), text);
    if (at != known.end()) return void(value = static_cast<Enum>(at - known.begin()));
    std::string names;
    for (const char* n : known) names += (names.empty() ? "" : " | ") + std::string(n);
    reject(name, "'" + text + "'", names);
}

struct Loader {
    const mrpt::config::CConfigFileBase& config;
    const std::string& section;
    template <class T>
    void operator()(const char* name, T& value, const char*) const {
        if (!config.keyExists(section, name)) return;
        parse(name, withoutComment(config.read_string(section, name, "")), value);
    }
};
template <class T>
std::string textOf(const T& value) {
    if constexpr (std::is_same_v<T, bool>)
        return value ? "true" : "false";
    else if constexpr (std::is_enum_v<T>)
        return enumNames(value)[static_cast<std::size_t>(value)];
    else
        return numberText(value);
}

struct Saver {
    mrpt::config::CConfigFileBase& config;
    const std::string& section;
    template <class T>
    void operator()(const char* name, const T& value, const char* comment) const {
        config.write(section, name, textOf(value), 20, 10, comment);
    }
};
/** The number of threads is no part of a map: maps of equal content are equal files. */
bool isStored(std::string_view name) {
    return name != "threads";
}

/** The insertion options in the order of map formats 1 and 2. */
constexpr const char* kStreamed[] = {"min_range",        "max_range",         "beyond_max_range",
                                     "estimator",        "surface_range",     "free_radius",
                                     "max_evidence",     "sampling_distance", "search_range_origin",
                                     "search_range_max", "search_region",     "covariance_center",
                                     "covariance_floor", "bandwidth",         "isotropic_length",
                                     "scale_search",     "scale_min_length",  "scale_max",
                                     "prior_alpha",      "prior_beta",        "seed"};

template <class Parameters, class Visitor>
void visitInStreamOrder(Parameters& o, Visitor&& visit) {
    if constexpr (std::is_base_of_v<InsertionParameters, std::remove_const_t<Parameters>>) {
        for (const std::string_view wanted : kStreamed)
            visitFields(o, [&](const char* name, auto& value, const char* comment) {
                if (name == wanted) visit(name, value, comment);
            });
    } else {
        visitFields(o, visit);
    }
}

/** The first version of the map format that holds an option. */
int firstVersionOf(std::string_view name) {
    return name == "beyond_max_range" || name == "max_evidence" ? 2 : 1;
}

/** What the meaning of a map's cells depends on, not only what is done with them next. */
bool isRequired(std::string_view name) {
    return name == "prior_alpha" || name == "prior_beta";
}

struct TextWriter {
    std::string& text;
    template <class T>
    void operator()(const char* name, const T& value, const char*) const {
        if (isStored(name)) text += lineOf({name, textOf(value), isRequired(name)});
    }
};
struct TextReader {
    NamedValues& values;
    template <class T>
    void operator()(const char* name, T& value, const char*) const {
        if (!isStored(name)) return;
        if (const std::string* text = values.take(name)) parse(name, *text, value);
    }
};
/** Formats 1 and 2: the options one behind the other, without names. */
struct StreamReader {
    mrpt::serialization::CArchive& in;
    int version;
    template <class T>
    void operator()(const char* name, T& value, const char*) const {
        if (version < firstVersionOf(name)) return;
        if constexpr (std::is_enum_v<T>)
            value = static_cast<T>(in.ReadAs<uint8_t>());
        else if constexpr (std::is_same_v<T, bool>)
            value = readBool(name);
        else
            in >> value;
    }

 private:
    bool readBool(const char* name) const {
        const auto byte = in.ReadAs<uint8_t>();
        require(byte <= 1, name, byte, "0 or 1");
        return byte == 1;
    }
};

}  // namespace

void RenderingParameters::validate() const {
    requireProbability("threshold", threshold);
}

void readOption(const mrpt::config::CConfigFileBase& c, const std::string& section,
                const char* name, double& value) {
    Loader{c, section}(name, value, "");
}

template <class Parameters>
void LoadableOptions<Parameters>::loadFromConfigFile(const mrpt::config::CConfigFileBase& c,
                                                     const std::string& s) {
    Parameters loaded = *this;
    visitFields(loaded, Loader{c, s});
    loaded.validate();
    static_cast<Parameters&>(*this) = loaded;
}
template <class Parameters>
void LoadableOptions<Parameters>::saveToConfigFile(mrpt::config::CConfigFileBase& c,
                                                   const std::string& s) const {
    visitFields(*this, Saver{c, s});
}
template <class Parameters>
std::string LoadableOptions<Parameters>::toText() const {
    std::string text;
    visitFields(*this, TextWriter{text});
    return text;
}
template <class Parameters>
void LoadableOptions<Parameters>::fromText(const std::string& section, const std::string& text) {
    NamedValues values(section, text);
    Parameters loaded = *this;
    try {
        visitFields(loaded, TextReader{values});
        loaded.validate();
    } catch (const std::invalid_argument& e) {
        throw CorruptMap(e.what());
    }
    values.requireNoneLeft();
    static_cast<Parameters&>(*this) = loaded;
}
template <class Parameters>
void LoadableOptions<Parameters>::readFromStream(mrpt::serialization::CArchive& in,
                                                 uint8_t version) {
    Parameters loaded = *this;
    try {
        visitInStreamOrder(loaded, StreamReader{in, version});
        loaded.validate();
    } catch (const std::invalid_argument& e) {
        throw CorruptMap(e.what());
    }
    static_cast<Parameters&>(*this) = loaded;
}

template struct LoadableOptions<InsertionParameters>;
template struct LoadableOptions<LikelihoodParameters>;
template struct LoadableOptions<RenderingParameters>;

}  // namespace akimap
