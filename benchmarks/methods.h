// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <akimap/Options.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "evaluation/evaluate.h"
#include "scenes.h"

namespace akimap::bench {

/** A scan in the forms that the maps take, made before any clock runs. Returns out of range are
 * left out, for all maps alike. */
struct PreparedScan {
    std::vector<Ray> rays;
    PointCloudScan cloud;
};
[[nodiscard]] std::vector<PreparedScan> prepare(const std::vector<std::vector<Ray>>& scans,
                                                double max_range);

/** A map that is judged. */
class MapUnderTest {
 public:
    virtual ~MapUnderTest() = default;
    virtual void insert(const PreparedScan& scan) = 0;
    /** Of the cell at a place [m]; empty where the map has no evidence. */
    [[nodiscard]] virtual std::optional<double> occupancy(double x, double y, double z) const = 0;
};

struct MapSettings {
    double resolution = 0.05;  ///< [m]
    double max_range = 8;      ///< [m] of the scans that will come
    uint64_t seed = 1;
    unsigned threads = 1;  ///< of AkiMap; the others have one
    app::Box box;          ///< of all scans [m], for dense grids
};

/** For the scans of a scene; 5 cm if it has no truth. */
[[nodiscard]] MapSettings settingsFor(const Scene& scene, uint64_t seed);

struct Method {
    std::string name;
    std::string what;     ///< the implementation and its parameters
    bool random = false;  ///< whether the map depends on the seed
    std::function<std::unique_ptr<MapUnderTest>(const MapSettings&)> make;
    std::size_t most_runs = 1000;  ///< to average: slow methods get fewer
};

/** One for each recording of a scene; of a single one, one for each seed if the method is random.
 */
[[nodiscard]] std::size_t runsOf(const Method& method, std::size_t recordings, int seeds);

/** AkiMap's own modes: first the default. */
[[nodiscard]] std::vector<Method> akimapMethods();
/** MRPT's maps, and what the paper compares with. */
[[nodiscard]] std::vector<Method> otherMethods();

/** AkiMap with some options changed. */
[[nodiscard]] Method akimapMethod(const std::string& name, const std::string& what,
                                  const std::function<void(InsertionParameters&)>& set);

/** A map of all scans, and the seconds that their insertion took. */
struct BuiltMap {
    std::unique_ptr<MapUnderTest> map;
    double seconds;
};
[[nodiscard]] BuiltMap build(const Method& method, const MapSettings& settings,
                             const std::vector<PreparedScan>& scans);

/** Reads from the map, which must outlive what is returned. */
[[nodiscard]] app::OccupancyLookup lookupIn(const MapUnderTest& map);

}  // namespace akimap::bench
