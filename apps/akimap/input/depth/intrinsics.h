// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <string>

namespace akimap::app {

/** A camera without distortion. */
struct Intrinsics {
    double fx = 0, fy = 0, cx = 0, cy = 0;  ///< [pixels]
};

/** \param text fx,fy,cx,cy, or a file of these four numbers, of a 3 x 3 matrix, or Open3D's .json
 * \exception std::runtime_error naming it */
[[nodiscard]] Intrinsics readIntrinsics(const std::string& text);

}  // namespace akimap::app
