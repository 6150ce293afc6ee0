// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <akimap/Options.h>
#include <mrpt/config/CConfigFileBase.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <stdexcept>
#include <string_view>

#include "mrpt/option_fields.h"
#include "support/require.h"

namespace akimap {
namespace {

/** In the C locale, whatever the program's is. */
template <class Number>
std::enable_if_t<std::is_arithmetic_v<Number>> parse(const std::string& name,
                                                     const std::string& text, Number& value) {
    const char* const end = text.data() + text.size();
    const char* const begin = text.data() + (text.size() > 1 && text[0] == '+');
    Number v{};
    const auto [stop, error] = std::from_chars(begin, end, v);
    if (error != std::errc() || stop != end)
        reject(name, "'" + text + "'",
               std::is_integral_v<Number> ? "a whole number >= 0, and not too large" : "a number");
    value = v;
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

/** The value without a comment behind it. */
std::string firstWord(const std::string& text) {
    const std::string line = text.substr(0, text.find("//"));
    const auto begin = line.find_first_not_of(" \t\r");
    if (begin == std::string::npos) return "";
    auto end = line.find_first_of(";#", begin);
    if (end == std::string::npos) end = line.size();
    while (end > begin && std::isspace(static_cast<unsigned char>(line[end - 1]))) --end;
    return line.substr(begin, end - begin);
}

struct Loader {
    const mrpt::config::CConfigFileBase& config;
    const std::string& section;
    template <class T>
    void operator()(const char* name, T& value, const char*) const {
        if (!config.keyExists(section, name)) return;
        parse(name, firstWord(config.read_string(section, name, "")), value);
    }
};
struct Saver {
    mrpt::config::CConfigFileBase& config;
    const std::string& section;
    template <class T>
    void operator()(const char* name, const T& value, const char* comment) const {
        if constexpr (std::is_same_v<T, double>)
            put(name, shortest(value), comment);
        else if constexpr (std::is_same_v<T, bool>)
            put(name, value ? "true" : "false", comment);
        else if constexpr (std::is_enum_v<T>)
            put(name, enumNames(value)[static_cast<std::size_t>(value)], comment);
        else
            put(name, std::to_string(value), comment);
    }

 private:
    void put(const char* name, const std::string& value, const char* comment) const {
        config.write(section, name, value, 20, 10, comment);
    }
    /** The fewest digits that read back the same. */
    static std::string shortest(double v) {
        char text[32];
        return {text, std::to_chars(text, text + sizeof text, v).ptr};
    }
};
/** The options in the order of map formats 1 and 2: those of a scan, but for the number of threads,
 * which is no part of a map. */
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

struct StreamWriter {
    mrpt::serialization::CArchive& out;
    template <class T>
    void operator()(const char*, const T& value, const char*) const {
        if constexpr (std::is_enum_v<T>)
            out << static_cast<uint8_t>(value);
        else
            out << value;
    }
};
struct StreamReader {
    mrpt::serialization::CArchive& in;
    int version;
    template <class T>
    void operator()(const char* name, T& value, const char*) const {
        if (version < firstVersionOf(name)) return;
        if constexpr (std::is_enum_v<T>)
            value = static_cast<T>(in.ReadAs<uint8_t>());
        else
            in >> value;
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
void LoadableOptions<Parameters>::writeToStream(mrpt::serialization::CArchive& out) const {
    visitInStreamOrder(*this, StreamWriter{out});
}
template <class Parameters>
void LoadableOptions<Parameters>::readFromStream(mrpt::serialization::CArchive& in,
                                                 uint8_t version) {
    Parameters loaded = *this;
    visitInStreamOrder(loaded, StreamReader{in, version});
    loaded.validate();
    static_cast<Parameters&>(*this) = loaded;
}

template struct LoadableOptions<InsertionParameters>;
template struct LoadableOptions<LikelihoodParameters>;
template struct LoadableOptions<RenderingParameters>;

}  // namespace akimap
