// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <cstddef>
#include <vector>

namespace akimap {

/** The problem of Eq. (7) for one sample: its neighbours inside the kernel's initial support, by
 * their distances r from it in the metric of its covariance. Reusable; not thread-safe. */
class ScaleProblem {
 public:
    void clear();
    [[nodiscard]] bool isEmpty() const { return size_ == 0; }
    /** \param u squared distance r^2 \param positive whether it has the sample's label */
    void add(float u, bool positive);

    /** Eq. (7) at the length scale s (H = s^2 * covariance), without the constant factor
     * |covariance|^(-1/2) / 2. */
    [[nodiscard]] double objective(double s) const;

    /** The s in [lowest, highest] that minimises Eq. (7): the best of a fixed set of candidates,
     * polished between its neighbours; of equal minima the largest. */
    [[nodiscard]] double minimise(double lowest, double highest) const;

    /** The derivative of Eq. (7) by s as the authors' code has it: right as long as all neighbours
     * lie inside the support. \param weight |covariance|^(-1/2) [m^-3] */
    [[nodiscard]] double gradient(double weight, double s) const;

    /** The authors' minimiser: gradient descent from s = 1 with a rate of 0.01 / epoch, clamped to
     * [lowest, 1]. Its gradients reach the thousands, so most runs jump to a bound or stay.
     * \param weight |covariance|^(-1/2) [m^-3], which scales the gradient */
    [[nodiscard]] double descend(double weight, double lowest) const;

 private:
    [[nodiscard]] double bestCandidate(double lowest, double step) const;
    [[nodiscard]] double polish(double a, double b) const;
    [[nodiscard]] double slope(double s) const;
    void startRow();
    std::size_t size_ = 0, rows_end_ = 0;
    bool spread_ = false;             // whether there are positives but at the sample itself
    double nearest_negative_ = 0;     // the least r of a negative
    std::vector<double> r_, target_;  // targets t of Eq. (6); whole rows, padded
};

}  // namespace akimap
