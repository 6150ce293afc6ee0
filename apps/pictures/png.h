// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <mrpt/img/CImage.h>

#include <string>

namespace akimap::app {

/** The bytes of a PNG file of a coloured picture. To be written by whoever notices a full disk:
 * MRPT's own writer does not. */
[[nodiscard]] std::string pngOf(const mrpt::img::CImage& image);

}  // namespace akimap::app
