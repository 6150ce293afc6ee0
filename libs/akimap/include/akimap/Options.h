// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <akimap/Parameters.h>
#include <mrpt/config/CLoadableOptions.h>
#include <mrpt/serialization/CArchive.h>

#include <cstdint>
#include <string>

namespace akimap {

/** Parameters that MRPT can load, save and stream; the field names are the INI keys.
 * Loading keeps the present value of a missing key and throws std::invalid_argument, naming the
 * key and changing nothing, on a bad value. */
template <class Parameters>
struct LoadableOptions : public Parameters, public mrpt::config::CLoadableOptions {
    void loadFromConfigFile(const mrpt::config::CConfigFileBase& c, const std::string& s) override;
    void saveToConfigFile(mrpt::config::CConfigFileBase& c, const std::string& s) const override;
    /** As map files have them: a line `name = value` each, see doc/format.md. */
    [[nodiscard]] std::string toText() const;
    /** Options that the text lacks keep their present values; ones that are not known are skipped
     * unless the text requires them. \param section for the messages
     * \exception std::runtime_error on bad text or values, naming them; nothing is changed */
    void fromText(const std::string& section, const std::string& text);
    /** \param version 1 or 2 of the map's format; options that it lacks keep their present values
     * \exception std::runtime_error on bad values; nothing is changed */
    void readFromStream(mrpt::serialization::CArchive& in, uint8_t version);
};

using TInsertionOptions = LoadableOptions<InsertionParameters>;    ///< `<prefix>_insertOpts`
using TLikelihoodOptions = LoadableOptions<LikelihoodParameters>;  ///< `<prefix>_likelihoodOpts`
using TRenderingOptions = LoadableOptions<RenderingParameters>;    ///< `<prefix>_renderOpts`

}  // namespace akimap
