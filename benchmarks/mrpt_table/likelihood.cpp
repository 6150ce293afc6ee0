// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <cmath>

#include "Row.h"

namespace akimap::bench {
namespace {

using mrpt::poses::CPose3D;

const std::vector<std::pair<std::string, CPose3D>> kWrongPoses{
    {"half a metre before it, in free space", CPose3D(-0.5, 0, 0, 0, 0, 0)},
    {"half a metre behind it, in the unknown", CPose3D(0.5, 0, 0, 0, 0, 0)},
    {"off the map", CPose3D(900, 900, 0, 0, 0, 0)}};

std::string likelihood(const MapKind& kind, const Sample& s) {
    const auto map = mapOf(kind, s);
    if (!map->canComputeObservationLikelihood(*s.observation)) return "declines";
    const double truth = map->computeObservationLikelihood(*s.observation, s.robot);
    bool finite = std::isfinite(truth), blind = true;
    std::string as_good;
    for (const auto& [name, offset] : kWrongPoses) {
        const double wrong = map->computeObservationLikelihood(*s.observation, offset + s.robot);
        finite = finite && std::isfinite(wrong), blind = blind && wrong == truth;
        if (wrong >= truth) as_good += (as_good.empty() ? "" : "; ") + name;
    }
    if (!finite) return "not finite";
    if (blind) return "the same everywhere";
    return as_good.empty() ? "best at the true pose" : "as good or better: " + as_good;
}

}  // namespace

Section likelihoodRows(const std::vector<Sample>& samples) {
    Section section{"Likelihood",
                    "`computeObservationLikelihood(observation, pose)` in a map of the same "
                    "returns: at the true pose, half a metre before and behind it, and where "
                    "nothing is mapped; "
                    "*declines*: `canComputeObservationLikelihood` is false.",
                    {}};
    for (const Sample& s : samples)
        section.rows.push_back({s.name, [s](const MapKind& kind) { return likelihood(kind, s); }});
    return section;
}

}  // namespace akimap::bench
