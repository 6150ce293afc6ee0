// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <akimap/Options.h>
#include <mrpt/config/CConfigFileBase.h>
#include <mrpt/typemeta/TEnumType.h>

#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string_view>

#include "grid/named_values.h"
#include "grid/sections.h"
#include "mrpt/option_fields.h"
#include "support/ini.h"
#include "support/numbers.h"

MRPT_ENUM_TYPE_BEGIN(akimap::Estimator)
MRPT_FILL_ENUM_MEMBER(akimap::Estimator, paper);
MRPT_FILL_ENUM_MEMBER(akimap::Estimator, surface);
MRPT_ENUM_TYPE_END()
MRPT_ENUM_TYPE_BEGIN(akimap::BeyondMaxRange)
MRPT_FILL_ENUM_MEMBER(akimap::BeyondMaxRange, ignore);
MRPT_FILL_ENUM_MEMBER(akimap::BeyondMaxRange, free);
MRPT_ENUM_TYPE_END()
MRPT_ENUM_TYPE_BEGIN(akimap::Bandwidth)
MRPT_FILL_ENUM_MEMBER(akimap::Bandwidth, adaptive);
MRPT_FILL_ENUM_MEMBER(akimap::Bandwidth, covariance);
MRPT_FILL_ENUM_MEMBER(akimap::Bandwidth, isotropic);
MRPT_ENUM_TYPE_END()
MRPT_ENUM_TYPE_BEGIN(akimap::SearchRegion)
MRPT_FILL_ENUM_MEMBER(akimap::SearchRegion, ball);
MRPT_FILL_ENUM_MEMBER(akimap::SearchRegion, box);
MRPT_ENUM_TYPE_END()
MRPT_ENUM_TYPE_BEGIN(akimap::ScaleSearch)
MRPT_FILL_ENUM_MEMBER(akimap::ScaleSearch, exact);
MRPT_FILL_ENUM_MEMBER(akimap::ScaleSearch, descent);
MRPT_ENUM_TYPE_END()
MRPT_ENUM_TYPE_BEGIN(akimap::CovarianceCenter)
MRPT_FILL_ENUM_MEMBER(akimap::CovarianceCenter, sample);
MRPT_FILL_ENUM_MEMBER(akimap::CovarianceCenter, mean);
MRPT_ENUM_TYPE_END()

namespace akimap {
namespace {

[[noreturn]] void reject(const std::string& name, const std::string& value,
                         const std::string& want) {
    throw std::invalid_argument(name + " = " + value + ": must be " + want);
}

void require(bool ok, const char* name, double value, const char* want) {
    if (ok) return;
    char text[32];
    std::snprintf(text, sizeof text, "%g", value);
    reject(name, text, want);
}

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
    std::string names;
    for (int i = 0; i <= 255; i++) {
        std::string candidate;
        try {
            candidate = mrpt::typemeta::TEnumType<Enum>::value2name(static_cast<Enum>(i));
        } catch (const std::exception&) {
            break;  // past the last
        }
        if (candidate == text) return void(value = static_cast<Enum>(i));
        names += (i ? " | " : "") + candidate;
    }
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
        return mrpt::typemeta::TEnumType<T>::value2name(value);
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
/** The number of threads is not part of a map: maps of equal content are equal files. */
bool isStreamed(const char* name) {
    return std::string_view(name) != "threads";
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
        if (isStreamed(name)) text += lineOf({name, textOf(value), isRequired(name)});
    }
};
struct TextReader {
    NamedValues& values;
    template <class T>
    void operator()(const char* name, T& value, const char*) const {
        if (!isStreamed(name)) return;
        if (const std::string* text = values.take(name)) parse(name, *text, value);
    }
};
/** Formats 1 and 2: the options one behind the other, without names. */
struct StreamReader {
    mrpt::serialization::CArchive& in;
    int version;
    template <class T>
    void operator()(const char* name, T& value, const char*) const {
        if (!isStreamed(name) || version < firstVersionOf(name)) return;
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

void requirePositive(const char* name, double v) {
    require(std::isfinite(v) && v > 0, name, v, "finite and > 0");
}
void requireNonNegative(const char* name, double v) {
    require(std::isfinite(v) && v >= 0, name, v, "finite and >= 0");
}
void requireProbability(const char* name, double v) {
    require(v > 0 && v < 1, name, v, "between 0 and 1");
}

template <class Enum>
void requireKnown(const char* name, Enum v, Enum last) {
    require(v <= last, name, static_cast<double>(v), "one of its named values");
}

}  // namespace

void InsertionParameters::validate() const {
    requireNonNegative("min_range", min_range);
    requirePositive("max_range", max_range);
    require(max_range > min_range, "max_range", max_range, "greater than min_range");
    requireKnown("beyond_max_range", beyond_max_range, BeyondMaxRange::free);
    requireKnown("estimator", estimator, Estimator::surface);
    requirePositive("surface_range", surface_range);
    requirePositive("free_radius", free_radius);
    requireNonNegative("max_evidence", max_evidence);
    require(max_evidence == 0 || max_evidence >= 1, "max_evidence", max_evidence,
            "0 (none) or at least 1");
    requirePositive("sampling_distance", sampling_distance);
    require(max_range / sampling_distance < 1e6, "sampling_distance", sampling_distance,
            "at least a millionth of max_range");
    requireNonNegative("search_range_origin", search_range_origin);
    requirePositive("search_range_max", search_range_max);
    requireNonNegative("covariance_floor", covariance_floor);
    requirePositive("isotropic_length", isotropic_length);
    requireNonNegative("scale_min_length", scale_min_length);
    requirePositive("scale_max", scale_max);
    requirePositive("prior_alpha", prior_alpha);
    requirePositive("prior_beta", prior_beta);
    requireKnown("bandwidth", bandwidth, Bandwidth::isotropic);
    requireKnown("search_region", search_region, SearchRegion::box);
    requireKnown("scale_search", scale_search, ScaleSearch::descent);
    requireKnown("covariance_center", covariance_center, CovarianceCenter::mean);
}

void LikelihoodParameters::validate() const {
    require(decimation >= 1, "decimation", decimation, ">= 1");
    requireNonNegative("sigma_hit", sigma_hit);
    requireProbability("p_unknown", p_unknown);
    requireProbability("p_outlier", p_outlier);
    requirePositive("independent_returns", independent_returns);
}

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
        visitFields(loaded, StreamReader{in, version});
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
