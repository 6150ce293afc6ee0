// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "plane_residuals.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>

#include "numeric/kd_tree.h"
#include "quantile.h"

namespace akimap::bench {
namespace {

using Vector = Eigen::Vector3d;

/** A scan's returns by direction. */
struct Bundle {
    std::vector<Vector> ends, directions;
    std::vector<double> ranges;
    std::array<std::vector<float>, 3> coordinates;  // of the directions
};

Bundle bundleOf(const std::vector<Ray>& rays) {
    Bundle b;
    for (const Ray& r : rays) {
        const Vector end(r.end[0], r.end[1], r.end[2]);
        const Vector sight = end - Vector(r.origin[0], r.origin[1], r.origin[2]);
        const double range = sight.norm();
        if (!std::isfinite(range) || range == 0) continue;
        b.ends.push_back(end), b.ranges.push_back(range), b.directions.push_back(sight / range);
        for (std::size_t i = 0; i < 3; i++)
            b.coordinates[i].push_back(static_cast<float>(sight[static_cast<int>(i)] / range));
    }
    return b;
}

using Neighbors = std::vector<Neighbor>;

/** Standard deviation along the rays [m]; empty if the patch is no plane seen from before. */
std::optional<double> residualOf(const Bundle& b, const Neighbors& patch, double max_incidence) {
    constexpr double kNarrow = 0.1;  // of a patch's variances: a single ring of a lidar spans none
    Vector mean = Vector::Zero();
    for (const auto& n : patch) mean += b.ends[n.index];
    mean /= static_cast<double>(patch.size());
    Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
    for (const auto& n : patch) {
        const Vector d = b.ends[n.index] - mean;
        scatter += d * d.transpose();
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(scatter);
    if (axes.eigenvalues()[1] < kNarrow * axes.eigenvalues()[2]) return std::nullopt;
    const Vector normal = axes.eigenvectors().col(0);
    double squares = 0;
    for (const auto& n : patch) {
        const double cosine = normal.dot(b.directions[n.index]);
        if (std::abs(cosine) < std::cos(max_incidence)) return std::nullopt;
        const double along = normal.dot(b.ends[n.index] - mean) / cosine;
        squares += along * along;
    }
    return std::sqrt(squares / static_cast<double>(patch.size() - 3));
}

void addPatches(const Bundle& b, const ResidualOptions& o,
                std::vector<std::vector<double>>& residuals) {
    const auto& [x, y, z] = b.coordinates;
    const Coordinates coordinates{{&x, &y, &z}};
    const KdTree<3> tree(coordinates);
    const std::size_t size = b.ends.size(), step = std::max<std::size_t>(1, size / o.patches);
    const auto chord = static_cast<float>(2 * std::sin(0.5 * o.cone));
    for (std::size_t i = 0; i < size; i += step) {
        const auto bin = std::upper_bound(o.edges.begin(), o.edges.end(), b.ranges[i]);
        if (bin == o.edges.begin() || bin == o.edges.end()) continue;
        const float query[] = {x[i], y[i], z[i]};
        const Neighbors patch = tree.nearest(query, size, chord * chord);
        if (patch.size() < o.min_returns) continue;
        if (const auto residual = residualOf(b, patch, o.max_incidence))
            residuals[static_cast<std::size_t>(bin - o.edges.begin()) - 1].push_back(*residual);
    }
}

}  // namespace

std::vector<ResidualBin> planeResiduals(const std::vector<std::vector<Ray>>& scans,
                                        const ResidualOptions& options) {
    if (options.edges.size() < 2 ||
        std::adjacent_find(options.edges.begin(), options.edges.end(),
                           [](double a, double b) { return !(a < b); }) != options.edges.end())
        throw std::invalid_argument("bins of range: two edges or more in order are needed");
    std::vector<std::vector<double>> residuals(options.edges.size() - 1);
    for (const auto& scan : scans) addPatches(bundleOf(scan), options, residuals);
    std::vector<ResidualBin> bins;
    for (std::size_t i = 0; i < residuals.size(); i++) {
        const double median = app::quantile(residuals[i], 0.5);
        bins.push_back({options.edges[i], options.edges[i + 1], residuals[i].size(), median,
                        app::quantile(residuals[i], 0.25)});
    }
    return bins;
}

}  // namespace akimap::bench
