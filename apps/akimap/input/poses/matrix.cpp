// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "input/poses/matrix.h"

#include <mrpt/math/CQuaternion.h>

#include <Eigen/Dense>
#include <cmath>
#include <stdexcept>
#include <string>

namespace akimap::app {

using mrpt::poses::CPose3D;

CPose3D poseOfMatrix(const double* m, std::size_t rows) {
    constexpr double kTolerance = 1e-2;  // files of few digits
    if (rows == 4 && (m[12] != 0 || m[13] != 0 || m[14] != 0 || m[15] != 1))
        throw std::runtime_error("the last row of a 4 x 4 pose must be 0 0 0 1");
    Eigen::Matrix3d rotation;
    for (int row = 0; row < 3; row++)
        for (int column = 0; column < 3; column++) rotation(row, column) = m[4 * row + column];
    const Eigen::Matrix3d error = rotation * rotation.transpose() - Eigen::Matrix3d::Identity();
    if (!(error.cwiseAbs().maxCoeff() < kTolerance))
        throw std::runtime_error("the left 3 x 3 numbers of the pose are no rotation");
    if (rotation.determinant() < 0)
        throw std::runtime_error("the left 3 x 3 numbers of the pose are a mirror, no rotation");
    const Eigen::Quaterniond q = Eigen::Quaterniond(rotation).normalized();
    return CPose3D(mrpt::math::CQuaternionDouble(q.w(), q.x(), q.y(), q.z()), m[3], m[7], m[11]);
}

CPose3D poseOfQuaternion(const std::array<double, 3>& translation, double qx, double qy, double qz,
                         double qw) {
    const double norm = std::hypot(std::hypot(qx, qy), std::hypot(qz, qw));
    if (std::abs(norm - 1) > 0.05)
        throw std::runtime_error("qx qy qz qw is not a unit quaternion: its norm is " +
                                 std::to_string(norm));
    return CPose3D(mrpt::math::CQuaternionDouble(qw / norm, qx / norm, qy / norm, qz / norm),
                   translation[0], translation[1], translation[2]);
}

}  // namespace akimap::app
