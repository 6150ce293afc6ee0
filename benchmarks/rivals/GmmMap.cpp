// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "rivals/GmmMap.h"
#include "grid/BlockGrid.h"

#include <mrpt/system/CTicTac.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

namespace akimap::bench {
namespace {

constexpr double kTolerance = 1e-5;      // of the mean log-likelihood
constexpr double kVarianceFloor = 1e-6;  // [m^2], keeps walls and lone points invertible
constexpr double kTiny = 1e-12;          // keeps an empty component from dividing by 0

double logOdds(double p) {
    return std::log(p / (1 - p));
}

CellIndex cellOf(const std::array<double, 3>& p, double resolution) {
    const auto axis = [&](double v) { return static_cast<int32_t>(std::floor(v / resolution)); };
    return {axis(p[0]), axis(p[1]), axis(p[2])};
}

Eigen::Vector3d normalVector(std::mt19937& random) {
    std::normal_distribution<double> normal;
    const double x = normal(random), y = normal(random), z = normal(random);
    return {x, y, z};
}

/** k-means++: picks `count` of the points x, far apart.
 * \return NxK, 1 where the point's nearest pick is k, else 0 */
Eigen::ArrayXXd nearestOf(const Eigen::Matrix3Xd& x, std::ptrdiff_t count, std::mt19937& random) {
    Eigen::ArrayXd squared = Eigen::ArrayXd::Ones(x.cols());
    std::vector<std::ptrdiff_t> nearest(static_cast<std::size_t>(x.cols()), 0);
    for (std::ptrdiff_t k = 0; k < count; k++) {
        std::discrete_distribution<std::ptrdiff_t> pick(squared.data(),
                                                        squared.data() + squared.size());
        const Eigen::Vector3d mean = x.col(pick(random));
        const Eigen::ArrayXd d = (x.colwise() - mean).colwise().squaredNorm();
        for (std::ptrdiff_t i = 0; i < x.cols(); i++)
            if (k == 0 || d[i] < squared[i])
                squared[i] = d[i], nearest[static_cast<std::size_t>(i)] = k;
    }
    Eigen::ArrayXXd parts = Eigen::ArrayXXd::Zero(x.cols(), count);
    for (std::ptrdiff_t i = 0; i < x.cols(); i++)
        parts(i, nearest[static_cast<std::size_t>(i)]) = 1;
    return parts;
}

/** The mixture that is likeliest where point i belongs to component k by parts(i, k). */
Mixture maximize(const Eigen::Matrix3Xd& x, const Eigen::ArrayXXd& parts) {
    Mixture m;
    for (std::ptrdiff_t k = 0; k < parts.cols(); k++) {
        const Eigen::VectorXd w = parts.col(k);
        const double sum = w.sum() + kTiny;
        m.weights.push_back(sum / static_cast<double>(x.cols()));
        m.means.emplace_back(x * w / sum);
        const Eigen::Matrix3Xd d = x.colwise() - m.means.back();
        m.covariances.emplace_back(d * w.asDiagonal() * d.transpose() / sum +
                                   kVarianceFloor * Eigen::Matrix3d::Identity());
    }
    return m;
}

/** To what part each point belongs to each component. \return the mean log-likelihood */
double expect(const Eigen::Matrix3Xd& x, const Mixture& m, Eigen::ArrayXXd& parts) {
    constexpr double kPi = 3.14159265358979323846;
    for (std::ptrdiff_t k = 0; k < parts.cols(); k++) {
        const auto i = static_cast<std::size_t>(k);
        const Eigen::Matrix3d root = m.covariances[i].llt().matrixL();
        const Eigen::Matrix3d inverse = root.inverse();
        const double scale =
            std::log(m.weights[i] / root.diagonal().prod()) - 1.5 * std::log(2 * kPi);
        parts.col(k) =
            scale -
            0.5 *
                (inverse * (x.colwise() - m.means[i])).colwise().squaredNorm().transpose().array();
    }
    const Eigen::ArrayXd highest = parts.rowwise().maxCoeff();
    parts = (parts.colwise() - highest).exp();
    const Eigen::ArrayXd sum = parts.rowwise().sum();
    parts.colwise() /= sum;
    return (highest + sum.log()).mean();
}

/** \return count points */
std::vector<Eigen::Vector3d> sample(const Mixture& mixture, int count, std::mt19937& random) {
    std::vector<Eigen::Matrix3d> roots;
    for (const auto& c : mixture.covariances) roots.emplace_back(c.llt().matrixL());
    std::discrete_distribution<std::size_t> component(mixture.weights.begin(),
                                                      mixture.weights.end());
    std::vector<Eigen::Vector3d> points;
    for (int i = 0; i < count; i++) {
        const std::size_t k = component(random);
        points.emplace_back(mixture.means[k] + roots[k] * normalVector(random));
    }
    return points;
}

}  // namespace

Mixture fitMixture(const std::vector<Eigen::Vector3d>& points, int components, int iterations,
                   uint64_t seed) {
    const Eigen::Matrix3Xd x =
        Eigen::Map<const Eigen::Matrix3Xd>(points.front().data(), 3, std::ptrdiff_t(points.size()));
    std::mt19937 random(static_cast<std::mt19937::result_type>(seed));
    const auto most = std::max<std::ptrdiff_t>(1, x.cols() / 10);
    Eigen::ArrayXXd parts = nearestOf(x, std::min<std::ptrdiff_t>(components, most), random);
    Mixture m = maximize(x, parts);
    double last = -std::numeric_limits<double>::infinity();
    for (int i = 0; i < iterations; i++) {
        const double likelihood = expect(x, m, parts);
        if (likelihood - last < kTolerance) break;
        last = likelihood;
        m = maximize(x, parts);
    }
    return m;
}

// Amanatides & Woo (1987).
std::vector<CellIndex> cellsOnRay(const Ray& ray, double resolution) {
    const CellIndex first = cellOf(ray.origin, resolution), last = cellOf(ray.end, resolution);
    std::array<int32_t, 3> cell{first.x, first.y, first.z}, step{};
    const std::array<int32_t, 3> end{last.x, last.y, last.z};
    std::array<double, 3> next{}, width{};  // where the ray leaves the cell, in parts of the ray
    for (std::size_t k = 0; k < 3; k++) {
        const double d = ray.end[k] - ray.origin[k];
        step[k] = d < 0 ? -1 : 1;
        width[k] = resolution / std::abs(d);
        next[k] = d == 0 ? std::numeric_limits<double>::infinity()
                         : ((cell[k] + (d > 0)) * resolution - ray.origin[k]) / d;
    }
    std::vector<CellIndex> cells{first};
    while (cell != end) {
        // Never past the last cell, whatever the rounding.
        std::size_t axis = 3;
        for (std::size_t k = 0; k < 3; k++)
            if (cell[k] != end[k] && (axis == 3 || next[k] < next[axis])) axis = k;
        cell[axis] += step[axis];
        next[axis] += width[axis];
        cells.push_back({cell[0], cell[1], cell[2]});
    }
    return cells;
}

bool GmmMap::update(const CellIndex& c, double occupancy) {
    const auto [i, is_new] = index_.insert(packKey(c), static_cast<uint32_t>(cells_.size()));
    if (is_new) cells_.push_back({0, 0});
    if (cells_[i].scan == scan_) return false;
    cells_[i] = {std::clamp(cells_[i].log_odds + static_cast<float>(logOdds(occupancy)),
                            static_cast<float>(logOdds(options_.lowest)),
                            static_cast<float>(logOdds(options_.highest))),
                 scan_};
    return true;
}

void GmmMap::insert(const std::vector<Ray>& scan) {
    std::vector<Eigen::Vector3d> hits;
    Ray from{};
    for (const Ray& r : scan) {
        if (length(r) > options_.max_range) continue;
        hits.emplace_back(r.end[0], r.end[1], r.end[2]);
        from.origin = r.origin;
    }
    if (hits.empty()) return;
    mrpt::system::CTicTac clock;
    const Mixture mixture =
        fitMixture(hits, options_.components, options_.iterations, options_.seed);
    seconds_fitting_ += clock.Tac();

    scan_++;
    std::vector<Ray> rays;  // one to each hit cell
    for (const auto& p : sample(mixture, options_.samples, random_)) {
        const Ray r{from.origin, {p.x(), p.y(), p.z()}};
        if (update(cellOf(r.end, options_.resolution), options_.hit)) rays.push_back(r);
    }
    for (const Ray& r : rays)
        for (const CellIndex& c : cellsOnRay(r, options_.resolution)) update(c, options_.miss);
}

std::optional<double> GmmMap::occupancy(double x, double y, double z) const {
    const uint32_t i = index_.find(packKey(cellOf({x, y, z}, options_.resolution)));
    if (i == KeyTable::kNone) return std::nullopt;
    return 1 / (1 + std::exp(-static_cast<double>(cells_[i].log_odds)));
}

}  // namespace akimap::bench
