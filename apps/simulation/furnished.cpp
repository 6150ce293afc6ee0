// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
// Two rooms with what makes maps of homes and offices hard: thin legs, doors, glass, a slope.

#include <cmath>

#include "simulation/furniture.h"

namespace akimap::app {

using mrpt::math::TPoint3D;

namespace {

/** Four square legs of this width [m] under a board from z = underside to top. */
void addLegs(Scene& scene, const TPoint3D& low, const TPoint3D& high, double leg, double board) {
    for (const double x : {low.x, high.x - leg})
        for (const double y : {low.y, high.y - leg})
            addCrate(scene, {x, y, low.z}, {x + leg, y + leg, high.z - board});
    addCrate(scene, {low.x, low.y, high.z - board}, high);
}

/** A wall along y, 10 cm thick, with a door of 0.9 m and one of 0.8 m, 1.9 m high, and a window. */
void addPartition(Scene& scene) {
    constexpr double kFront = 5.0, kBack = 5.1, kDoor = 1.9;  // [m]
    const auto wall = [&](double y0, double y1, double z0, double z1) {
        addCrate(scene, {kFront, y0, z0}, {kBack, y1, z1});
    };
    wall(0, 1.0, 0, kHeight);
    wall(1.0, 1.9, kDoor, kHeight);
    wall(1.9, 3.0, 0, kHeight);
    wall(3.0, 4.2, 0, 0.9);
    wall(3.0, 4.2, 1.7, kHeight);
    wall(4.2, 5.0, 0, kHeight);
    wall(5.0, 5.8, kDoor, kHeight);
    wall(5.8, kWidth, 0, kHeight);
    addCrate(scene, {5.045, 3.0, 0.9}, {5.055, 4.2, 1.7}, Material::glass);
}

/** \param back  -1 or 1: at which end along x the chair's back stands */
void addChair(Scene& scene, double x, double y, int back) {
    constexpr double kSide = 0.42, kSeat = 0.45, kLeg = 0.025, kBoard = 0.03, kTop = 0.9;
    addLegs(scene, {x, y, 0}, {x + kSide, y + kSide, kSeat}, kLeg, kBoard);
    const double at = back < 0 ? x : x + kSide - kLeg;
    addCrate(scene, {at, y, kSeat}, {at + kLeg, y + kSide, kTop});
}

/** Upright, of 4 cm across, on a flat foot. */
void addLamp(Scene& scene, double x, double y) {
    constexpr double kPole = 0.02, kFoot = 0.14, kFootHeight = 0.03, kTop = 1.6, kShade = 0.13;
    const double floor = Scene::floorHeight();
    scene.add(makePillar(x, y, kFoot, floor, floor + kFootHeight));
    scene.add(makePillar(x, y, kPole, floor + kFootHeight, floor + kTop));
    scene.add(makeSphere({x, y, floor + kTop + kShade}, kShade));
}

/** Four steps of 17 x 28 cm up along x to the wall. */
void addStairs(Scene& scene) {
    constexpr double kRise = 0.17, kRun = 0.28, kFirst = 8.6;
    for (int i = 0; i < 4; i++)
        addCrate(scene, {kFirst + i * kRun, 0, i * kRise}, {kLength, 1.0, (i + 1) * kRise});
}

/** A ramp of 10 degrees along x up to a platform of 26 cm. */
void addSlope(Scene& scene) {
    constexpr double kTilt = 10 * M_PI / 180, kTop = 0.26, kThick = 0.2;  // [rad], [m]
    constexpr double kPlatform = 8.2, kLow = 6.0, kHigh = 7.0;            // [m]
    addCrate(scene, {kPlatform, kLow, 0}, {kPlatform + 1, kHigh, kTop});
    // Its upper end meets the platform's edge; its lower end lies within the floor.
    const double length = kTop / std::sin(kTilt) + 0.1;
    const double x = kPlatform - 0.5 * length * std::cos(kTilt) + 0.5 * kThick * std::sin(kTilt);
    const double z = kTop - 0.5 * length * std::sin(kTilt) - 0.5 * kThick * std::cos(kTilt);
    scene.add(makeBox(
        {x + kCellMiddle, 0.5 * (kLow + kHigh) + kCellMiddle, z + kCellMiddle, 0, -kTilt, 0},
        {length, kHigh - kLow, kThick}));
}

void addLivingRoom(Scene& scene) {
    addLegs(scene, {1.4, 4.6, 0}, {2.8, 5.4, 0.75}, 0.04, 0.04);  // a table
    addChair(scene, 0.9, 4.75, -1);
    addChair(scene, 2.9, 4.75, 1);
    addChair(scene, 1.9, 5.55, 1);                                   // turned away
    addCrate(scene, {0, 1.4, 0}, {0.85, 3.2, 0.4}, Material::dark);  // a sofa
    addCrate(scene, {0, 1.4, 0.4}, {0.25, 3.2, 0.8}, Material::dark);
    addLamp(scene, 0.4, 0.8);
    addCrate(scene, {3.6, 0, 0}, {4.6, 0.4, 1.8});                     // a cupboard
    scene.add(makePillar(0.5, 6.5, 0.17, Scene::floorHeight(), 0.4));  // a plant
    scene.add(makeSphere({0.5, 6.5, 0.75}, 0.3));
}

void addStudy(Scene& scene) {
    addLegs(scene, {9.3, 2.4, 0}, {kLength, 4.0, 0.72}, 0.03, 0.03);      // a desk at the wall
    addCrate(scene, {9.7, 2.9, 0.77}, {9.75, 3.5, 1.1}, Material::dark);  // its screen
    addChair(scene, 8.7, 3.0, -1);
    const double floor = Scene::floorHeight();
    scene.add(makePillar(7.3, 4.6, 0.02, floor, floor + kHeight));  // two poles
    scene.add(makePillar(6.1, 1.2, 0.03, floor, floor + 1.2));
    addCrate(scene, {5.3, 2.1, 0}, {5.6, 2.9, 1.2});  // shelves
    addStairs(scene);
    addSlope(scene);
}

}  // namespace

Scene makeFurnished() {
    Scene scene;
    addRoom(scene);
    addPartition(scene);
    addLivingRoom(scene);
    addStudy(scene);
    scene.addPlace({2.6, 2.4, 0.4});
    scene.addPlace({3.9, 5.9, 2.8});
    scene.addPlace({6.4, 3.6, 0.2});
    scene.addPlace({7.7, 2.2, 1.5});
    return scene;
}

}  // namespace akimap::app
