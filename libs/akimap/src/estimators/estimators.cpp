// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "estimators/estimators.h"

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <sstream>
#include <stdexcept>

#include "estimators/paper/PaperEstimator.h"
#include "estimators/surface/SurfaceEstimator.h"

namespace akimap {
namespace {

/** TBB warns on stderr when it is asked for more threads than it allows. */
int threadsFor(const ScanParameters& p) {
    const auto most =
        tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
    return static_cast<int>(p.threads ? std::min<std::size_t>(p.threads, most) : most);
}

}  // namespace

std::unique_ptr<ScanEstimator> makeEstimator(Estimator estimator) {
    switch (estimator) {
        case Estimator::paper:
            return std::make_unique<PaperEstimator>();
        case Estimator::surface:
            return std::make_unique<SurfaceEstimator>();
    }
    return nullptr;
}

bool insertScan(ScanEstimator& estimator, const Scan& scan, const InsertionParameters& p,
                BlockGrid& grid, InsertionStats& stats) {
    p.validate();
    if (grid.resolution() > p.max_range)
        throw std::invalid_argument("resolution: a cell must not be larger than max_range");
    estimator.check(p, grid.resolution());
    bool changed = false;
    InsertionStats counted = stats;  // taken over when nothing can throw any more
    tbb::task_arena arena(threadsFor(p));
    arena.execute([&] { changed = estimator.insert(scan, p, grid, counted); });
    counted.scans += changed;
    stats = counted;
    return changed;
}

/** A kernel must stay within the block keys' margin, and a slip of a unit within the memory. */
void requireReachWithinGrid(const char* name, double reach, double resolution) {
    if (reach <= kMaxKernelCells * resolution) return;
    std::ostringstream text;
    text << name << ": kernels could reach " << reach << " m, more than " << kMaxKernelCells
         << " cells of " << resolution << " m";
    throw std::invalid_argument(text.str());
}

}  // namespace akimap
