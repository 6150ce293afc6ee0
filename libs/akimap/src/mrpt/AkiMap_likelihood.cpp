// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <akimap/rays.h>

#include <algorithm>
#include <cmath>

#include "mrpt/Impl.h"
#include "queries/HitModel.h"
#include "sensors/returns.h"

namespace akimap {
namespace {

/** Sum of the logarithms of probabilities, with few logarithms taken. */
class LogProduct {
 public:
    void multiply(double p) {
        if (p < kSmall) return void(log_ += std::log(p));
        product_ *= p;
        if (product_ < kSmall) log_ += std::log(product_), product_ = 1;
    }
    [[nodiscard]] double value() const { return log_ + std::log(product_); }

 private:
    static constexpr double kSmall = 1e-150;  // its square is still a number
    double log_ = 0, product_ = 1;
};

}  // namespace

bool AkiMap::internal_canComputeObservationLikelihood(const mrpt::obs::CObservation& obs) const {
    return givesRays(obs);
}

/** Each return is a hit on the map near its end (HitModel), or an outlier. Which returns are used
 * does not depend on the pose, so that no pose gains by looking away. */
double AkiMap::internal_computeObservationLikelihood(const mrpt::obs::CObservation& obs,
                                                     const mrpt::poses::CPose3D& takenFrom) const {
    const LikelihoodParameters& l = likelihoodOptions;
    l.validate();
    HitModel model(viewOf(*this), l);
    LogProduct product;
    double used = 0;
    forEachReturn(obs, takenFrom, std::max(1u, l.decimation), [&](const Ray& ray) {
        const double dx = ray.end[0] - ray.origin[0], dy = ray.end[1] - ray.origin[1],
                     dz = ray.end[2] - ray.origin[2];
        const double range = std::sqrt(dx * dx + dy * dy + dz * dz);  // faster than std::hypot()
        if (!insertionOptions.takesLength(range)) return;             // NaN is not taken either
        product.multiply((1 - l.p_outlier) * model.hit(ray, range) + l.p_outlier);
        ++used;
    });
    return used > 0 ? product.value() * std::min(1.0, l.independent_returns / used) : 0;
}

}  // namespace akimap
