// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <algorithm>

namespace akimap {

/** A symmetric 3x3 matrix. */
struct Symmetric3 {
    double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
};

/** A positive definite matrix H factored as L D L^T (Cholesky without roots), z first:
 *   d^T H^-1 d = dz^2 / vz + ey^2 / vy + (dx - x_z dz - x_y ey)^2 / vx,  ey = dy - y_z dz.
 * All terms are positive, so nothing cancels however flat the ellipsoid is, and |H| = vx vy vz. */
struct Ldlt {
    double vz, y_z, vy, x_z, x_y, vx;

    explicit Ldlt(const Symmetric3& h) {
        // Moments are summed in floats: where the floor is smaller than their rounding, H may come
        // out singular or worse. No kernel is flatter than this.
        constexpr double kFlattest = 1e-6;
        vz = h.zz;
        y_z = h.yz / vz;
        vy = std::max(h.yy - y_z * h.yz, kFlattest * h.yy);
        x_z = h.xz / vz;
        x_y = (h.xy - x_z * h.yz) / vy;
        vx = std::max(h.xx - x_z * h.xz - x_y * x_y * vy, kFlattest * h.xx);
    }
    [[nodiscard]] double determinant() const { return vx * vy * vz; }
};

}  // namespace akimap
