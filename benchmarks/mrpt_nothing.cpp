// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
// What a program costs that uses a map of MRPT and does nothing: the loading of MRPT's libraries.

#include <mrpt/maps/COctoMap.h>

int main() {
    const mrpt::maps::COctoMap map(0.1);
}
