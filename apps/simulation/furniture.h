// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include "simulation/Scene.h"

namespace akimap::app {

// Multiples of 5 cm plus this lie in the middle of a 5 cm cell and a quarter into a 10 cm one.
inline constexpr double kCellMiddle = 0.025;
inline constexpr double kLength = 10, kWidth = 7, kHeight = 2;  // [m] of the room, along x, y, z

void addRoom(Scene& scene);

/** A box with level faces; opposite corners [m], to which kCellMiddle is added. */
void addCrate(Scene& scene, const mrpt::math::TPoint3D& low, const mrpt::math::TPoint3D& high,
              Material material = Material::matte);

/** SceneKind::furnished, in furnished.cpp. */
Scene makeFurnished();

}  // namespace akimap::app
