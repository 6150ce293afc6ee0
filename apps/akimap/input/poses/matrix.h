// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <mrpt/poses/CPose3D.h>

#include <array>

namespace akimap::app {

/** \param m three or four rows of four numbers
 * \exception std::runtime_error if this is not a rotation and a translation */
[[nodiscard]] mrpt::poses::CPose3D poseOfMatrix(const double* m, std::size_t rows);

/** \exception std::runtime_error if it is not of length 1 */
[[nodiscard]] mrpt::poses::CPose3D poseOfQuaternion(const std::array<double, 3>& translation,
                                                    double qx, double qy, double qz, double qw);

}  // namespace akimap::app
