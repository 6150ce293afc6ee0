// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "report/places.h"

namespace akimap::bench {
namespace {

constexpr double kResolution = 0.05;  // [m]

/** A piece of the wall at x = 0 and of the floor. \param x, y [m] least corner of that piece */
std::vector<Patch> wallAndFloor(double wall_y, double floor_x, double floor_y, double floor_z = 0) {
    constexpr double kBehind = 0.15, kBefore = 0.3;  // [m]
    return {
        {"A wall", {{-kBehind, wall_y, 0.4}, {kBefore, wall_y + 2, 1.8}}, 0.6, 0.4},
        {"The floor",
         {{floor_x, floor_y, floor_z - kBehind}, {floor_x + 2, floor_y + 1.7, floor_z + kBefore}},
         0.6,
         0.7}};
}

std::function<Scene(uint64_t)> byDepthCamera(app::SceneKind kind) {
    return [kind](uint64_t seed) { return simulated(kind, seed, kResolution); };
}

}  // namespace

std::vector<Scene> recordingsOf(const Place& place) {
    std::vector<Scene> scenes;
    for (int seed = 1; seed <= place.recordings; seed++)
        scenes.push_back(place.take(static_cast<uint64_t>(seed)));
    return scenes;
}

std::vector<Place> la3dmAsShipped() {
    const Scene scene = la3dmStructured();
    if (scene.scans.empty()) return {};
    return {{scene.name, "la3dm",
             "Beside the paper's figures, and for nothing else: the sensor's height in these files "
             "is 0.3 m too low, which rewards a map for ignoring what its rays saw, and constants "
             "of the default were chosen on them. One recording of 12 scans, so that only random "
             "methods vary.",
             1, wallAndFloor(6, 2, 7, 0.1), [scene](uint64_t) { return scene; }}};
}

std::vector<Place> simulatedPlaces(int recordings) {
    std::vector<Place> places;
    places.push_back(
        {"structured", "structured",
         "A simulated room of 10 x 7 x 2 m with boxes, shelves and pillars; 12 scans by a depth "
         "camera of 80 x 46 pixels, noise 1 cm. Each recording has noise and places of its own.",
         recordings, wallAndFloor(2.8, 0.2, 2.9), byDepthCamera(app::SceneKind::structured)});
    places.push_back(
        {"unstructured", "unstructured",
         "The same with leaning slabs, spheres and pillars, drawn anew for each recording.",
         recordings, wallAndFloor(2.8, 0.2, 2.9), byDepthCamera(app::SceneKind::unstructured)});
    places.push_back(
        {"unstructured, lidar", "rings",
         "More such rooms by another sensor: a lidar of 16 rings, 2 degrees apart, 900 directions "
         "each, noise 2 cm, returns within 13 m. No constant of any method was chosen on them.",
         recordings, wallAndFloor(2.8, 4, 2.6),
         [](uint64_t seed) { return simulatedRings(seed, kResolution); }});
    return places;
}

}  // namespace akimap::bench
