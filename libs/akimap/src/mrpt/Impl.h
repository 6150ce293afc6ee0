// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <akimap/AkiMap.h>

#include "estimators/surface/evidence.h"

namespace akimap {

/** The buffers of every room, kept between scans so that insertion allocates little. */
struct AkiMap::Scratch {
    KeyTable taken;
    Samples samples;
    NeighborScratch neighbors;
    std::vector<Symmetric3> H;
    ScatterScratch scatter;
    EvidenceScratch evidence;
};

}  // namespace akimap
