// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <mrpt/maps/CPointsMap.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/poses/CPose2D.h>
#include <mrpt/tfest/TMatchingPair.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "mrpt/Impl.h"

namespace akimap {
namespace {

using mrpt::maps::CMetricMap;
using mrpt::maps::CPointsMap;
using mrpt::math::TPoint3Df;
using mrpt::tfest::TMatchingPair;

struct Cloud {
    const float *x, *y, *z;
    std::size_t size;
};

Cloud cloudOf(const CPointsMap& map) {
    return {map.getPointsBufferRef_x().data(), map.getPointsBufferRef_y().data(),
            map.getPointsBufferRef_z().data(), map.size()};
}
Cloud cloudOf(const SurfacePoints& points) {
    return {points.x().data(), points.y().data(), points.z().data(), points.size()};
}

TPoint3Df pointOf(const SurfacePoints& points, std::size_t i) {
    return {points.x()[i], points.y()[i], points.z()[i]};
}

float square(float v) {
    return v * v;
}

/** Measures in the map's frame: in 3D, or from above. */
struct Measure {
    bool from_above;
    [[nodiscard]] float sqrDistance(const TPoint3Df& a, const TPoint3Df& b) const {
        return square(a.x - b.x) + square(a.y - b.y) + (from_above ? 0 : square(a.z - b.z));
    }
    /** How far a partner may be. */
    [[nodiscard]] float reach(const TPoint3Df& p, const mrpt::maps::TMatchingParams& params) const {
        const float lever = std::sqrt(sqrDistance(p, params.angularDistPivotPoint.cast<float>()));
        return params.maxDistForCorrespondence + params.maxAngularDistForCorrespondence * lever;
    }
};

/** Calls visit(Neighbor), its distance as measured, for the partners of a point. */
template <class Visitor>
void forEachPartner(const SurfacePoints& surface, const TPoint3Df& p, const Measure& measure,
                    const mrpt::maps::TMatchingParams& params, Visitor&& visit) {
    const SurfacePoints::Point3 query{p.x, p.y, p.z};
    const auto nearest = surface.nearest(query);
    if (!nearest) return;
    const float sqr_reach = square(measure.reach(p, params));
    const auto visitIfWithin = [&](uint32_t i) {
        const float d = measure.sqrDistance(pointOf(surface, i), p);
        if (d < sqr_reach) visit(Neighbor{i, d});
    };
    if (params.onlyKeepTheClosest) return visitIfWithin(nearest->index);
    // From above, the ball must still reach as far out at the height of the nearest.
    const float up = measure.from_above ? square(surface.z()[nearest->index] - p.z) : 0;
    for (const Neighbor& n : surface.nearest(query, surface.size(), sqr_reach + up))
        visitIfWithin(n.index);
}

TMatchingPair pairOf(const SurfacePoints& surface, const Neighbor& n, const Cloud& other,
                     std::size_t i) {
    TMatchingPair pair;
    pair.globalIdx = n.index;
    pair.global = pointOf(surface, n.index);
    pair.localIdx = static_cast<decltype(pair.localIdx)>(i);
    pair.local = {other.x[i], other.y[i], other.z[i]};
    pair.errorSquareAfterTransformation = n.sqr_distance;
    return pair;
}

void match(const SurfacePoints& surface, const Cloud& other, const mrpt::poses::CPose3D& pose,
           const Measure& measure, const mrpt::maps::TMatchingParams& params,
           mrpt::tfest::TMatchingPairList& pairs, mrpt::maps::TMatchingExtraResults& extra) {
    if (params.decimation_other_map_points == 0)
        throw std::invalid_argument("decimation_other_map_points = 0: must be >= 1");
    pairs.clear();
    extra = {};
    double sum = 0;
    std::size_t seen = 0, paired = 0;
    for (std::size_t i = params.offset_other_map_points; i < other.size;
         i += params.decimation_other_map_points, seen++) {
        TPoint3Df p;
        pose.composePoint(other.x[i], other.y[i], other.z[i], p.x, p.y, p.z);
        const std::size_t before = pairs.size();
        forEachPartner(surface, p, measure, params, [&](const Neighbor& n) {
            pairs.push_back(pairOf(surface, n, other, i));
            sum += static_cast<double>(n.sqr_distance);
        });
        paired += pairs.size() > before;
    }
    if (seen) extra.correspondencesRatio = static_cast<float>(paired) / static_cast<float>(seen);
    if (paired) extra.sumSqrDist = static_cast<float>(sum / static_cast<double>(pairs.size()));
    if (params.onlyUniqueRobust) {
        mrpt::tfest::TMatchingPairList unique;
        pairs.filterUniqueRobustPairs(surface.size(), unique);
        pairs.swap(unique);
    }
}

}  // namespace

const SurfacePoints& AkiMap::surface() const {
    return impl_->surface.get(viewOf(*this));
}

std::vector<TPoint3Df> AkiMap::surfacePoints() const {
    const SurfacePoints& s = surface();
    std::vector<TPoint3Df> points;
    points.reserve(s.size());
    for (std::size_t i = 0; i < s.size(); i++) points.push_back(pointOf(s, i));
    return points;
}

void AkiMap::determineMatching2D(const CMetricMap* otherMap,
                                 const mrpt::poses::CPose2D& otherMapPose,
                                 mrpt::tfest::TMatchingPairList& correspondences,
                                 const mrpt::maps::TMatchingParams& params,
                                 mrpt::maps::TMatchingExtraResults& extraResults) const {
    if (const auto* points = dynamic_cast<const CPointsMap*>(otherMap))
        return match(surface(), cloudOf(*points), mrpt::poses::CPose3D(otherMapPose), {true},
                     params, correspondences, extraResults);
    if (const auto* aki = dynamic_cast<const AkiMap*>(otherMap))
        return match(surface(), cloudOf(aki->surface()), mrpt::poses::CPose3D(otherMapPose), {true},
                     params, correspondences, extraResults);
    throw std::invalid_argument("determineMatching2D: otherMap must be a CPointsMap or an AkiMap");
}

void AkiMap::determineMatching3D(const CMetricMap* otherMap,
                                 const mrpt::poses::CPose3D& otherMapPose,
                                 mrpt::tfest::TMatchingPairList& correspondences,
                                 const mrpt::maps::TMatchingParams& params,
                                 mrpt::maps::TMatchingExtraResults& extraResults) const {
    if (const auto* points = dynamic_cast<const CPointsMap*>(otherMap))
        return match(surface(), cloudOf(*points), otherMapPose, {false}, params, correspondences,
                     extraResults);
    if (const auto* aki = dynamic_cast<const AkiMap*>(otherMap))
        return match(surface(), cloudOf(aki->surface()), otherMapPose, {false}, params,
                     correspondences, extraResults);
    throw std::invalid_argument("determineMatching3D: otherMap must be a CPointsMap or an AkiMap");
}

float AkiMap::compute3DMatchingRatio(const CMetricMap* otherMap,
                                     const mrpt::poses::CPose3D& otherMapPose,
                                     const mrpt::maps::TMatchingRatioParams& params) const {
    const bool has_points = dynamic_cast<const CPointsMap*>(otherMap) != nullptr ||
                            dynamic_cast<const AkiMap*>(otherMap) != nullptr;
    if (!has_points && otherMap) otherMap = otherMap->getAsSimplePointsMap();
    if (!otherMap) return 0;
    mrpt::maps::TMatchingParams p;
    p.maxDistForCorrespondence = params.maxDistForCorr;
    mrpt::tfest::TMatchingPairList pairs;
    mrpt::maps::TMatchingExtraResults extra;
    determineMatching3D(otherMap, otherMapPose, pairs, p, extra);
    return extra.correspondencesRatio;
}

float AkiMap::squareDistanceToClosestCorrespondence(float x0, float y0) const {
    const auto nearest = surface().nearest(SurfacePoints::Point2{x0, y0});
    return nearest ? nearest->sqr_distance : std::numeric_limits<float>::max();
}

}  // namespace akimap
