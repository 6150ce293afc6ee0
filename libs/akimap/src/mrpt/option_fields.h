// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <akimap/Options.h>

#include <array>
#include <string>

#include "estimators/options.h"
#include "queries/options.h"

// The option lists of all that MRPT loads, saves and streams: visitFields(parameters, visit) calls
// visit(name, field, comment).

namespace akimap {

template <class Parameters, class Visitor>
IfFieldsOf<LikelihoodParameters, Parameters> visitFields(Parameters& o, Visitor&& visit) {
    visitLikelihoodFields(o, visit);
}

template <class Parameters, class Visitor>
IfFieldsOf<RenderingParameters, Parameters> visitFields(Parameters& o, Visitor&& visit) {
    visit("threshold", o.threshold, "[-] in (0,1). Cells of a higher occupancy are occupied");
    visit("show_free", o.show_free, "Draw free cells too, translucent");
    visit("max_voxels", o.max_voxels, "More cells than this are drawn as points, not voxels");
}

/** Reads one option as strictly as all are read; a missing key leaves the value.
 * \exception std::invalid_argument naming the key */
void readOption(const mrpt::config::CConfigFileBase& c, const std::string& section,
                const char* name, double& value);

}  // namespace akimap
