// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "localization.h"
#include "report/Report.h"
#include "report/places.h"
#include "report/predictions.h"
#include "scenes.h"
#include "watched_walk.h"

namespace akimap::bench {

/** What a sensor with its errors recorded of a simulated place, several times. */
struct NoisyPlace {
    std::string name;
    std::function<std::vector<Scene>()> take;  ///< takes seconds
};

/** What the report measures, in its order: the world first, then what comes ever less near to it.
 * Any part may be empty, and any real recording absent. */
struct Contents {
    std::vector<Trial> real;
    std::vector<NoisyPlace> noisy;
    std::vector<std::function<WatchedWalk()>> walks;
    std::function<std::vector<LocalizationCase>()> localization;
    LocalizationRules localization_rules;
    std::vector<LidarModel> lidars;  ///< to map on the fly
    std::vector<Place> clean;
    std::vector<Place> as_shipped;  ///< for the paper's own table only
};

/** \param seeds recordings of each clean scene; of noisy ones, a few */
[[nodiscard]] Contents standardContents(int seeds);

/** All sections. Fills Report::lost and Report::real. */
[[nodiscard]] std::string bodyOf(Report& report, const Contents& contents);

/** What AkiMap loses at, and what was chosen on which data; to come before the body, after it is
 * measured. */
[[nodiscard]] std::string openingOf(const Report& report);

}  // namespace akimap::bench
