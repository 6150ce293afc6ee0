// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <mrpt/img/TColor.h>

namespace akimap::app {

inline constexpr int kPictureWidth = 1600, kPictureHeight = 1000;  // [pixels]
inline constexpr int kPictureMargin = 32;
inline const mrpt::img::TColor kInk(38, 50, 64), kPaleInk(84, 96, 112);

}  // namespace akimap::app
