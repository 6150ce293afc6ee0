// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

// The method as the paper writes it, slow and obviously right: brute-force neighbours, double
// precision, Eq. (5) as printed, every cell tested. The library's fast path is held against it.

#include <Eigen/Dense>
#include <cmath>
#include <map>
#include <tuple>
#include <vector>

#include "estimators/hits.h"
#include "estimators/kernels/kernel_function.h"
#include "estimators/paper/bandwidth.h"

namespace akimap::reference {

/** How near a discrete decision came to falling the other way; floats may decide differently. */
struct Bandwidth {
    Eigen::Matrix3d H = {};
    bool ambiguous = false;
};

/** Local minima of Eq. (7) on a fine scan of s, each polished; the lowest first. */
struct Minimum {
    double s, value;
};

inline double objective(const std::vector<double>& positive, const std::vector<double>& negative,
                        double s) {
    double sum = 0;
    for (const double r : positive) sum += std::pow(kernelExact(r) - kernelExact(r / s), 2);
    for (const double r : negative) sum += std::pow(kernelExact(r / s), 2);
    return sum / (s * s * s);
}

inline std::vector<Minimum> minima(const std::vector<double>& positive,
                                   const std::vector<double>& negative, double lowest,
                                   double highest) {
    constexpr int kSteps = 400;
    const double step = (highest - lowest) / kSteps;
    const auto f = [&](double s) { return objective(positive, negative, s); };
    std::vector<double> values;
    for (int i = 0; i <= kSteps; i++) values.push_back(f(lowest + i * step));
    std::vector<Minimum> found;
    for (int i = 0; i <= kSteps; i++) {
        const auto at = [&](int k) {
            return k < 0 || k > kSteps ? INFINITY : values[static_cast<std::size_t>(k)];
        };
        if (at(i) > at(i - 1) || at(i) >= at(i + 1)) continue;  // of a plateau, the right end
        double a = std::max(lowest, lowest + (i - 1) * step),
               b = std::min(highest, lowest + (i + 1) * step);
        for (int k = 0; k < 60; k++) {  // ternary search, to the right where equal
            const double c = a + (b - a) / 3, d = b - (b - a) / 3;
            (f(c) < f(d) ? b : a) = f(c) < f(d) ? d : c;
        }
        const double s = i == kSteps && f(highest) <= f((a + b) / 2) ? highest : (a + b) / 2;
        found.push_back({s, f(s)});
    }
    std::sort(found.begin(), found.end(), [](auto& x, auto& y) { return x.value < y.value; });
    return found;
}

inline Eigen::Vector3d point(const Samples& s, std::size_t i) {
    return {s.x[i], s.y[i], s.z[i]};
}

inline Bandwidth bandwidth(const Samples& s, std::size_t i, const InsertionParameters& p,
                           double resolution) {
    if (p.bandwidth == akimap::Bandwidth::isotropic)
        return {Eigen::Matrix3d::Identity() * p.isotropic_length * p.isotropic_length};
    const double nearest = p.search_range_origin > 0 ? p.search_range_origin : resolution;
    const double range = nearest + (p.search_range_max - nearest) * s.distance[i] / p.max_range;
    const auto occupied = [&](std::size_t j) { return j < s.occupied; };

    Bandwidth result;
    std::vector<Eigen::Vector3d> positive, negative;
    for (std::size_t j = 0; j < s.size(); j++) {
        const Eigen::Vector3d d = point(s, j) - point(s, i);
        const double far =
            p.search_region == SearchRegion::ball ? d.norm() : d.cwiseAbs().maxCoeff();
        result.ambiguous |= std::abs(far - range) < 1e-6;
        if (far <= range) (occupied(i) == occupied(j) ? positive : negative).push_back(d);
    }
    const double n = static_cast<double>(positive.size());
    if (n <= 2) return {Eigen::Matrix3d::Identity() * resolution * resolution, result.ambiguous};

    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    if (p.covariance_center == CovarianceCenter::mean) {
        for (const auto& d : positive) mean += d / n;
    }
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    for (const auto& d : positive) covariance += (d - mean) * (d - mean).transpose();
    covariance /= p.covariance_center == CovarianceCenter::mean ? n - 1 : n - 2;
    covariance += Eigen::Matrix3d::Identity() *
                  (p.covariance_floor > 0 ? p.covariance_floor : 0.4 * resolution * resolution);
    result.H = covariance;
    if (p.bandwidth == akimap::Bandwidth::covariance) return result;

    const auto inSupport = [&](const std::vector<Eigen::Vector3d>& points) {
        std::vector<double> r;
        for (const auto& d : points) {
            r.push_back(std::sqrt(d.dot(covariance.inverse() * d)));
            result.ambiguous |= std::abs(r.back() - 1) < 1e-5;
            if (r.back() >= std::max(1.0, p.scale_max)) r.pop_back();
        }
        return r;
    };
    const auto r_positive = inSupport(positive), r_negative = inSupport(negative);
    if (r_negative.empty()) return result;
    const double longest =
        std::sqrt(Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvalues()[2]);
    const double shortest = p.scale_min_length > 0 ? p.scale_min_length : resolution;
    const auto found =
        minima(r_positive, r_negative, std::min(shortest / longest, p.scale_max), p.scale_max);
    result.ambiguous |= found.size() > 1 && found[1].value < found[0].value * 1.001 + 1e-12;
    result.H = found[0].s * found[0].s * covariance;
    return result;
}

/** One of the sums of Eq. (8)-(9) of a cell. */
struct Sum {
    double value = 0;
    double nearest = 1e9;  ///< the smallest r of the kernels that reach the cell
};
struct Cell {
    Sum alpha, beta;
    bool ambiguous = false;  ///< reached by a kernel whose bandwidth was a close call
    [[nodiscard]] double nearest() const { return std::min(alpha.nearest, beta.nearest); }
};
using Cells = std::map<std::tuple<int, int, int>, Cell>;

inline std::vector<Bandwidth> bandwidths(const Samples& s, const InsertionParameters& p,
                                         double resolution) {
    std::vector<Bandwidth> all;
    for (std::size_t i = 0; i < s.size(); i++) all.push_back(bandwidth(s, i, p, resolution));
    return all;
}

/** \param k the kernel as a function of r */
template <class KernelFunction>
Cells cells(const Samples& s, const std::vector<Bandwidth>& bandwidths, double resolution,
            KernelFunction&& k) {
    Cells cells;
    for (std::size_t i = 0; i < s.size(); i++) {
        const Bandwidth& b = bandwidths[i];
        const Eigen::Matrix3d inverse = b.H.inverse();
        const double weight = 1 / std::sqrt(b.H.determinant());
        const Eigen::Vector3d x = point(s, i);
        const double longest =
            std::sqrt(Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(b.H).eigenvalues()[2]);
        const int reach = static_cast<int>(longest / resolution) + 2;
        const Eigen::Array3i c = (x / resolution).array().floor().cast<int>();
        for (int kz = -reach; kz <= reach; kz++)
            for (int ky = -reach; ky <= reach; ky++)
                for (int kx = -reach; kx <= reach; kx++) {
                    const Eigen::Array3i at = c + Eigen::Array3i(kx, ky, kz);
                    const Eigen::Vector3d d = ((at.cast<double>() + 0.5) * resolution).matrix() - x;
                    const double r = std::sqrt(d.dot(inverse * d));
                    if (r >= 1.001) continue;  // a little more, to know of close calls
                    Cell& cell =
                        cells[{s.anchor.x + at[0], s.anchor.y + at[1], s.anchor.z + at[2]}];
                    Sum& sum = i < s.occupied ? cell.alpha : cell.beta;
                    sum.value += weight * k(r);
                    sum.nearest = std::min(sum.nearest, r);
                    cell.ambiguous |= b.ambiguous;
                }
    }
    return cells;
}

}  // namespace akimap::reference
