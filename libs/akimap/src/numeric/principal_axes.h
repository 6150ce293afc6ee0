// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <cmath>
#include <utility>

#include "numeric/rows.h"

namespace akimap {

/** Eight symmetric matrices of 3 x 3, one a lane. */
struct SymmetricRows {
    Row xx, xy, xz, yy, yz, zz;
};

/** Eigenvalues in increasing order, and the eigenvectors, of unit length: axis[i] of value[i]. */
struct PrincipalAxes {
    Row value[3], axis[3][3];
};

AKIMAP_INLINE Row rootOf(Row v) {
    alignas(32) float lanes[8];  // a loop that the compiler turns into one instruction
    storeRow(lanes, v);
    for (float& lane : lanes) lane = std::sqrt(lane);
    return loadRow(lanes);
}

/** Jacobi's rotation in the plane of two axes p and q, which makes pq zero (Golub and Van Loan,
 * Matrix Computations, 8.5). */
AKIMAP_INLINE void rotate(Row& pp, Row& qq, Row& pq, Row& rp, Row& rq, Row (&p)[3], Row (&q)[3]) {
    constexpr Row one = {1, 1, 1, 1, 1, 1, 1, 1};
    constexpr float kTiny = 1e-30f;  // no rotation where all is zero
    const Row d = qq - pp, root = rootOf(d * d + 4.0f * pq * pq) + kTiny;
    const Row tangent = 2.0f * pq / (d + (d < 0.0f ? -root : root));
    const Row c = one / rootOf(tangent * tangent + 1.0f), s = tangent * c;
    pp -= tangent * pq, qq += tangent * pq, pq = Row{};
    const auto turn = [=](Row& a, Row& b) AKIMAP_INLINE_LAMBDA {
        const Row turned = c * a - s * b;
        b = s * a + c * b;
        a = turned;
    };
    turn(rp, rq);
    for (int i = 0; i < 3; i++) turn(p[i], q[i]);
}

/** Puts axes i and j in order. */
AKIMAP_INLINE void order(PrincipalAxes& a, int i, int j) {
    const auto select = [swap = a.value[j] < a.value[i]](Row& x, Row& y) AKIMAP_INLINE_LAMBDA {
        const Row first = swap ? y : x;
        y = swap ? x : y;
        x = first;
    };
    for (int k = 0; k < 3; k++) select(a.axis[i][k], a.axis[j][k]);
    select(a.value[i], a.value[j]);
}

/** To within the rounding of floats, relative to the trace. \param m positive semidefinite */
AKIMAP_INLINE PrincipalAxes principalAxes(SymmetricRows m) {
    constexpr int kSweeps = 4;  // enough for floats
    constexpr Row one = {1, 1, 1, 1, 1, 1, 1, 1}, zero{};
    const Row trace = m.xx + m.yy + m.zz;
    const Row scale = trace > zero ? one / trace : one;
    for (Row* v : {&m.xx, &m.xy, &m.xz, &m.yy, &m.yz, &m.zz}) *v *= scale;
    PrincipalAxes a{{}, {{one, zero, zero}, {zero, one, zero}, {zero, zero, one}}};
    for (int sweep = 0; sweep < kSweeps; sweep++) {
        rotate(m.xx, m.yy, m.xy, m.xz, m.yz, a.axis[0], a.axis[1]);
        rotate(m.xx, m.zz, m.xz, m.xy, m.yz, a.axis[0], a.axis[2]);
        rotate(m.yy, m.zz, m.yz, m.xy, m.xz, a.axis[1], a.axis[2]);
    }
    a.value[0] = m.xx / scale, a.value[1] = m.yy / scale, a.value[2] = m.zz / scale;
    order(a, 0, 1), order(a, 1, 2), order(a, 0, 1);
    return a;
}

}  // namespace akimap
