// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <gtest/gtest.h>

#include <ostream>

#include "estimators/estimators.h"
#include "random_scans.h"
#include "surface_reference.h"

using namespace akimap;

namespace {

struct Case {
    const char* name;
    double resolution;
    std::size_t rays;  ///< of each scan
    double max_range;  ///< [m]
    bool has_beams;    ///< that met nothing
    double max_evidence;
};

void PrintTo(const Case& c, std::ostream* out) {
    *out << c.name;
}

/** Cells whose alpha or beta is not the reference's. Floats are off by 1e-7 of a few cells' length
 * and of sums of some ten weights; the tails of the normal distribution make that 1e-3 of what is
 * small, and what is smaller than 1e-5 decides nothing. */
struct Comparison {
    std::size_t cells = 0, different = 0;
    void add(double alpha, double beta, const reference::surface::State& exact) {
        const auto near = [](double a, double b) { return std::abs(a - b) <= 1e-3 * b + 1e-5; };
        cells++;
        different += !near(alpha, exact.alpha) || !near(beta, exact.beta);
    }
};

Comparison compare(const BlockGrid& grid, const reference::surface::SurfaceMap& map) {
    auto expected = map.cells();
    Comparison c;
    grid.forEachCell([&](const CellIndex& at, float alpha, float beta) {
        const auto& state = expected[{at.x, at.y, at.z}];
        c.add(static_cast<double>(alpha), static_cast<double>(beta), state);
        expected.erase({at.x, at.y, at.z});
    });
    for (const auto& [at, state] : expected)  // that the library does not have
        if (state.alpha + state.beta > 0) c.add(0, 0, state);
    return c;
}

/** With some beams that met nothing within the range, and some ends twice; the third scan sees
 * through what the others saw. */
std::vector<Ray> scanOf(const Case& c, unsigned number) {
    std::vector<Ray> rays = test::randomScan(number, c.rays);
    if (number == 3)
        for (Ray& r : rays) r.end = placeAlong(r, 1.4);
    for (Ray& r : rays)  // no sensor on a corner of cells, where rounding decides
        for (auto* p : {&r.origin, &r.end}) (*p)[0] += 0.0137, (*p)[1] += 0.0071, (*p)[2] += 0.0293;
    for (std::size_t i = 0; i < rays.size(); i += 11) {
        if (c.has_beams) rays[i].hit = false;
        rays.push_back(rays[i + 1]);
    }
    return rays;
}

class SurfaceReference : public testing::TestWithParam<Case> {};

}  // namespace

TEST_P(SurfaceReference, AgreesAfterEachScan) {
    const Case& c = GetParam();
    InsertionParameters p;
    p.max_range = c.max_range, p.max_evidence = c.max_evidence;
    p.beyond_max_range = c.has_beams ? BeyondMaxRange::free : BeyondMaxRange::ignore;
    BlockGrid grid(c.resolution);
    reference::surface::SurfaceMap map(p, c.resolution);
    const auto estimator = makeEstimator(Estimator::surface);
    InsertionStats stats;
    for (unsigned n = 1; n <= 3; n++) {
        const std::vector<Ray> rays = scanOf(c, n);
        insertScan(*estimator, {rays, n}, p, grid, stats);
        map.insert(rays);
        const Comparison result = compare(grid, map);
        EXPECT_GT(result.cells, 3000u);
        // A place on the edge of a ball, a cell or an ellipse may be rounded over it: a few cells.
        EXPECT_LT(static_cast<double>(result.different), 3e-4 * static_cast<double>(result.cells))
            << "scan " << n;
    }
}

INSTANTIATE_TEST_SUITE_P(All, SurfaceReference,
                         testing::Values(Case{"sparse", 0.05, 300, 8, false, 100},
                                         Case{"dense", 0.1, 1500, 8, false, 100},
                                         Case{"near", 0.05, 1000, 2, true, 100},
                                         Case{"beams", 0.1, 600, 2.5, true, 100},
                                         Case{"fading", 0.1, 600, 3, true, 3}),
                         [](const auto& test) { return std::string(test.param.name); });
