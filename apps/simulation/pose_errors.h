// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include "simulation/simulate.h"

namespace akimap::app {

/** Moves each scan's rays and recorded poses, rigidly, as a wrong pose at the scan's time does. The
 * views and the true trajectory stay. */
void misplace(SimulatedDrive& drive, const PoseErrors& errors, uint64_t seed);

}  // namespace akimap::app
