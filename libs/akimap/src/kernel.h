// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <cmath>

#include "simd.h"

namespace akimap {

/** The bounded kernel of Eq. (5), as printed: k(r) for r >= 0, 0 from r = 1 on. */
inline double kernelExact(double r) {
    constexpr double kPi = 3.14159265358979323846;
    const double e = 1 - r;
    if (e <= 0) return 0;
    const double x2 = 4 * kPi * kPi * e * e;
    // The three terms cancel down to e^5 at the edge: take their series there.
    if (e < 0.02)
        return e * x2 * x2 * (1.0 / 180 - x2 * (1.0 / 2520 - x2 * (1.0 / 90720 - x2 / 5987520)));
    return (2 + std::cos(2 * kPi * r)) / 3 * e + std::sin(2 * kPi * r) / (2 * kPi);
}

/** Eq. (5) as a polynomial in u = r^2, given g = 1 - u: no root, sine or cosine. k falls like
 * g^5 towards the edge, so the rest is fitted for *relative* error, at most 1.2e-4 on [0, 1).
 * Not clamped: negative where g < 0. */
template <class T>
AKIMAP_INLINE T kernelOfSquare(T u, T g) {
    T p = u * -0.981447644f + 4.02668009f;
    p = p * u - 6.87535778f;
    p = p * u + 6.46582903f;
    p = p * u - 3.94292404f;
    p = p * u + 2.1323476f;
    p = p * u - 1.55446411f;
    p = p * u + 0.999887105f;
    const T g2 = g * g;
    return g2 * g2 * g * p;
}

}  // namespace akimap
