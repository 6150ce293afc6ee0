// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "report/closeup.h"
#include "scenes.h"

namespace akimap::bench {

/** A scene with a known truth, of which there may be several recordings. */
struct Place {
    std::string name;  ///< as in Scene::name
    std::string file;  ///< for names of files, without spaces
    std::string what;  ///< room and sensor, in a sentence or two
    int recordings;
    std::vector<Patch> patches;                ///< of the first recording, for close-ups
    std::function<Scene(uint64_t seed)> take;  ///< seeds 1 to `recordings`; takes seconds
};
[[nodiscard]] std::vector<Scene> recordingsOf(const Place& place);

/** \param recordings of each simulated scene */
[[nodiscard]] std::vector<Place> simulatedPlaces(int recordings);

/** LA3DM's structured scene with the sensor's height that its files name; none if it is not there.
 */
[[nodiscard]] std::vector<Place> la3dmAsShipped();

}  // namespace akimap::bench
