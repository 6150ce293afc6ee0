// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include "grid/BlockGrid.h"

#include <Eigen/Core>
#include <random>

#include "rivals/Rival.h"

namespace akimap::bench {

/** A mixture of Gaussians. */
struct Mixture {
    std::vector<double> weights;  ///< their sum is 1
    std::vector<Eigen::Vector3d> means;
    std::vector<Eigen::Matrix3d> covariances;
};

/** Fits full covariances by expectation maximization: from the points nearest to each of
 * k-means++'s picks, at most `iterations`, until the mean log-likelihood gains less than 1e-5.
 * Fewer components if there are fewer than ten points for each. Each covariance has 1e-6 m^2 added
 * on its diagonal. \pre there are points */
[[nodiscard]] Mixture fitMixture(const std::vector<Eigen::Vector3d>& points, int components,
                                 int iterations, uint64_t seed);

/** The cells on a ray from the one with its origin to the one with its end, each one sharing a face
 * with the one before. */
[[nodiscard]] std::vector<CellIndex> cellsOnRay(const Ray& ray, double resolution);

/** The sensor model is ours: with 0.9, 0.25 and these limits the figures on LA3DM's scene come
 * close to the AKIMap paper's for 70 components (AUC 0.939, MSE 0.065); OctoMap's 0.7, 0.4, 0.12
 * and 0.97 give the same AUC and twice the MSE. */
struct GmmOptions {
    double resolution = 0.05;  ///< side of a cell [m]
    double max_range = 8;      ///< longer rays are dropped [m]
    int components = 70;       ///< of each scan's mixture
    int iterations = 30;       ///< of expectation maximization, at most (100: no better)
    int samples = 83333;       ///< drawn from each scan's mixture: 10^6 of LA3DM's 12 scans
    double hit = 0.9;          ///< occupancy that one scan's hit stands for
    double miss = 0.25;        ///< occupancy that one scan's miss stands for
    double lowest = 0.02;      ///< the occupancy is kept from falling below
    double highest = 0.98;     ///< the occupancy is kept from rising above
    uint64_t seed = 1;
};

/** GMM-OM (O'Meadhra, Tabib, Michael, RA-L 2019): each scan's hits become a mixture of Gaussians,
 * which is sampled; rays from the sensor to the samples, one to each cell that has any, update an
 * occupancy grid's log-odds. In one scan a cell is updated once, a hit before a miss. */
class GmmMap : public Rival {
 public:
    explicit GmmMap(const GmmOptions& options = {})
        : options_(options), random_(static_cast<std::mt19937::result_type>(options.seed)) {}
    void insert(const std::vector<Ray>& scan) override;
    [[nodiscard]] std::optional<double> occupancy(double x, double y, double z) const override;
    [[nodiscard]] double secondsFitting() const { return seconds_fitting_; }

 private:
    /** \return false if this scan has updated the cell before */
    bool update(const CellIndex& cell, double occupancy);

    GmmOptions options_;
    std::mt19937 random_;
    double seconds_fitting_ = 0;
    int scan_ = 0;
    KeyTable index_;  // cell -> its place in cells_
    struct Cell {
        float log_odds;
        int scan;  // the last one that updated it
    };
    std::vector<Cell> cells_;
};

}  // namespace akimap::bench
