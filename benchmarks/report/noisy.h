// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <string>
#include <vector>

#include "report/Report.h"
#include "scenes.h"

namespace akimap::bench {

/** A simulated sensor with its errors, in the furnished room. */
struct NoisySensor {
    std::string name;
    app::SensorKind kind;
    double max_range;  ///< [m] farther returns are lost
};
[[nodiscard]] std::vector<NoisySensor> noisySensors();

/** A drive of 12 scans with that sensor; the recorded poses are off by 1 cm and 0.3 degrees,
 * standard deviations on each axis, white. The truth is exact: what the scans can know from where
 * they truly were. Takes seconds. */
[[nodiscard]] Scene noisyScene(const NoisySensor& sensor, uint64_t seed, double resolution);

/** The maps of the contest against the truth of the recordings, a table like the clean scenes'; and
 * where their rays end in the first, as of real recordings.
 * \param recordings of one sensor, with a truth */
[[nodiscard]] std::string noisySection(Report& report, const std::vector<Scene>& recordings);

}  // namespace akimap::bench
