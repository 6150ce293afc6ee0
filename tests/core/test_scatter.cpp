// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include "estimators/paper/PaperEstimator.h"
#include "estimators/paper/free_samples.h"
#include "random_scans.h"
#include "reference.h"

using namespace akimap;

namespace {

struct Comparison {
    std::size_t compared = 0, ambiguous = 0;
    double worst = 0;       ///< relative error of a sum, over cells that a kernel reaches well
    double worst_edge = 0;  ///< the same over cells that kernels only just reach: k < 3e-6
};

/** One random scan through rooms 2 to 4. */
struct ScatteredScan {
    PaperWorkspace s;
    BlockGrid grid;
    ScatteredScan(const InsertionParameters& p, double resolution, unsigned seed)
        : grid(resolution) {
        InsertionStats stats;
        takeSamples(test::randomScan(seed, 250), p, grid, seed, s.taken, s.samples, stats);
        bandwidths(s.samples, p, resolution, s.neighbors, s.H);
        EXPECT_TRUE(scatter(s, grid));
    }
    [[nodiscard]] std::vector<reference::Bandwidth> ownBandwidths() const {
        std::vector<reference::Bandwidth> own;
        for (const Symmetric3& h : s.H) {
            own.emplace_back();
            own.back().H << h.xx, h.xy, h.xz, h.xy, h.yy, h.yz, h.xz, h.yz, h.zz;
        }
        return own;
    }
};

/** Cell by cell, against kernels k of these bandwidths. */
template <class KernelFunction>
Comparison compare(const ScatteredScan& scan, const std::vector<reference::Bandwidth>& bandwidths,
                   KernelFunction&& k) {
    Comparison c;
    reference::Cells expected =
        reference::cells(scan.s.samples, bandwidths, scan.grid.resolution(), k);
    scan.grid.forEachCell([&](const CellIndex& at, float alpha, float beta) {
        const auto found = expected.find({at.x, at.y, at.z});
        ASSERT_NE(found, expected.end()) << "no kernel reaches this cell";
        const reference::Cell cell = found->second;
        expected.erase(found);
        if (cell.ambiguous) return void(c.ambiguous++);
        EXPECT_LT(cell.nearest(), 1 + 1e-4);
        c.compared++;
        const auto hold = [&](double fast, const reference::Sum& exact) {
            if (exact.nearest > 1 - 1e-4) return;
            double& worst = exact.nearest < 0.95 ? c.worst : c.worst_edge;
            worst = std::max(worst, std::abs(fast / exact.value - 1));
        };
        hold(alpha, cell.alpha);
        hold(beta, cell.beta);
    });
    for (const auto& [at, cell] : expected) {  // cells that the fast path does not have
        if (!cell.ambiguous) {
            EXPECT_GT(cell.nearest(), 1 - 1e-4);
        }
    }
    return c;
}

class FastPath
    : public testing::TestWithParam<std::tuple<Bandwidth, SearchRegion, CovarianceCenter, double>> {
};

}  // namespace

TEST_P(FastPath, AgreesWithTheReference) {
    InsertionParameters p;
    std::tie(p.bandwidth, p.search_region, p.covariance_center, std::ignore) = GetParam();
    const double resolution = std::get<3>(GetParam());
    const auto polynomial = [](double r) {
        return kernelOfSquare(r * r, std::max(0.0, 1 - r * r));
    };
    for (unsigned seed = 1; seed <= 3; seed++) {
        const ScatteredScan scan(p, resolution, seed);
        const Comparison whole =
            compare(scan, reference::bandwidths(scan.s.samples, p, resolution), kernelExact);
        EXPECT_GT(whole.compared, 1500u);
        EXPECT_LT(whole.ambiguous, whole.compared / 20);
        EXPECT_LT(whole.worst, 1e-3) << "seed " << seed;
        EXPECT_LT(whole.worst_edge, 0.05) << "seed " << seed;
        // With the same bandwidths and the same kernel on both sides, what is left is rounding,
        // mostly of the polynomial in floats.
        const Comparison update = compare(scan, scan.ownBandwidths(), polynomial);
        EXPECT_EQ(update.ambiguous, 0u);
        EXPECT_LT(update.worst, 2e-5) << "seed " << seed;
    }
}

INSTANTIATE_TEST_SUITE_P(
    All, FastPath,
    testing::Combine(testing::Values(Bandwidth::adaptive, Bandwidth::covariance,
                                     Bandwidth::isotropic),
                     testing::Values(SearchRegion::ball, SearchRegion::box),
                     testing::Values(CovarianceCenter::sample, CovarianceCenter::mean),
                     testing::Values(0.05, 0.1)));
