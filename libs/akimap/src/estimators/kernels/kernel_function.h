// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <cmath>

#include "numeric/rows.h"

namespace akimap {

/** The bounded kernel of Eq. (5), as printed: k(r) for r >= 0, 0 from r = 1 on. */
inline double kernelExact(double r) {
    constexpr double kPi = 3.14159265358979323846;
    const double e = 1 - r;
    if (e <= 0) return 0;
    const double x2 = 4 * kPi * kPi * e * e;
    // The three terms cancel down to e^5 at the edge: take their series there.
    if (e < 0.02)
        return e * x2 * x2 * (1.0 / 180 - x2 * (1.0 / 3780 - x2 * (1.0 / 181440 - x2 / 14968800)));
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

/** Coefficients of Eq. (5) / (1 - r^2)^5 as a polynomial in r, the highest power first. */
constexpr double kRadiusCoefficients[] = {
    0.28616220614306342, -2.0536789078722051,   6.7069447715206953,  -13.2757601310824,
    17.932306306549268,  -17.681608165510784,   13.370769108733118,  -8.115086583148992,
    3.674504150087615,   0.0060209514569440625, -1.5799973726682102, 4.4906264944910568e-06,
    0.99999998716414051};

/** Eq. (5) to within 1.3e-8 of itself, as (1 - r^2)^5 times a polynomial in r; 0 from r = 1 on.
 * For rows of doubles, where a minimum has to be found to many digits. */
template <class T>
AKIMAP_INLINE T kernelOfRadius(T r) {
    const T u = r * r, g = keep(u < 1.0, 1.0 - u), g2 = g * g;
    T p = r * 0.0;
    for (const double c : kRadiusCoefficients) p = p * r + c;
    return g2 * g2 * g * p;
}

/** kernelOfRadius() and -r times its derivative. */
template <class T>
struct KernelAndFall {
    T k, fall;
};
template <class T>
AKIMAP_INLINE KernelAndFall<T> kernelAndFall(T r) {
    const T u = r * r, g = keep(u < 1.0, 1.0 - u), g2 = g * g, g4 = g2 * g2;
    T p = r * 0.0, slope = r * 0.0;
    for (const double c : kRadiusCoefficients) slope = slope * r + p, p = p * r + c;
    return {g4 * g * p, g4 * (10.0 * u * p - g * r * slope)};
}

}  // namespace akimap
