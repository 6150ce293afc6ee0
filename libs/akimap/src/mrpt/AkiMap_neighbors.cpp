// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
// MRPT's NearestNeighborsCapable, which mp2p_icp's matchers ask for.

#include <limits>

#include "mrpt/Impl.h"

namespace akimap {
namespace {

using mrpt::math::TPoint2Df;
using mrpt::math::TPoint3Df;

void assign(TPoint3Df& to, const SurfacePoints::Point3& from) {
    to = {from[0], from[1], from[2]};
}
void assign(TPoint2Df& to, const SurfacePoints::Point3& from) {
    to = {from[0], from[1]};
}
SurfacePoints::Point3 toQuery(const TPoint3Df& p) {
    return {p.x, p.y, p.z};
}
SurfacePoints::Point2 toQuery(const TPoint2Df& p) {
    return {p.x, p.y};
}

template <class Point>
bool single(const SurfacePoints& surface, const Point& query, Point& result, float& sqr_distance,
            uint64_t& index) {
    const auto nearest = surface.nearest(toQuery(query));
    if (!nearest) return false;
    assign(result, surface[nearest->index]);
    sqr_distance = nearest->sqr_distance;
    index = nearest->index;
    return true;
}

template <class Point>
void several(const SurfacePoints& surface, const Point& query, std::size_t count,
             float max_sqr_distance, std::vector<Point>& results, std::vector<float>& sqr_distances,
             std::vector<uint64_t>& indices) {
    const auto found = surface.nearest(toQuery(query), count, max_sqr_distance);
    results.resize(found.size());
    sqr_distances.resize(found.size());
    indices.resize(found.size());
    for (std::size_t i = 0; i < found.size(); i++) {
        assign(results[i], surface[found[i].index]);
        sqr_distances[i] = found[i].sqr_distance;
        indices[i] = found[i].index;
    }
}

constexpr float kAnyDistance = std::numeric_limits<float>::max();

std::size_t orAll(std::size_t most) {
    return most ? most : std::numeric_limits<std::size_t>::max();
}

}  // namespace

bool AkiMap::nn_has_indices_or_ids() const {
    return true;
}
void AkiMap::nn_prepare_for_2d_queries() const {
    surface().prepare2D();
}
void AkiMap::nn_prepare_for_3d_queries() const {
    surface().prepare3D();
}
std::size_t AkiMap::nn_index_count() const {
    return surface().size();
}

bool AkiMap::nn_single_search(const TPoint3Df& query, TPoint3Df& result, float& out_dist_sqr,
                              uint64_t& resultIndexOrID) const {
    return single(surface(), query, result, out_dist_sqr, resultIndexOrID);
}
bool AkiMap::nn_single_search(const TPoint2Df& query, TPoint2Df& result, float& out_dist_sqr,
                              uint64_t& resultIndexOrID) const {
    return single(surface(), query, result, out_dist_sqr, resultIndexOrID);
}

void AkiMap::nn_multiple_search(const TPoint3Df& query, std::size_t N,
                                std::vector<TPoint3Df>& results, std::vector<float>& out_dists_sqr,
                                std::vector<uint64_t>& resultIndicesOrIDs) const {
    several(surface(), query, N, kAnyDistance, results, out_dists_sqr, resultIndicesOrIDs);
}
void AkiMap::nn_multiple_search(const TPoint2Df& query, std::size_t N,
                                std::vector<TPoint2Df>& results, std::vector<float>& out_dists_sqr,
                                std::vector<uint64_t>& resultIndicesOrIDs) const {
    several(surface(), query, N, kAnyDistance, results, out_dists_sqr, resultIndicesOrIDs);
}

void AkiMap::nn_radius_search(const TPoint3Df& query, float search_radius_sqr,
                              std::vector<TPoint3Df>& results, std::vector<float>& out_dists_sqr,
                              std::vector<uint64_t>& resultIndicesOrIDs,
                              std::size_t maxPoints) const {
    several(surface(), query, orAll(maxPoints), search_radius_sqr, results, out_dists_sqr,
            resultIndicesOrIDs);
}
void AkiMap::nn_radius_search(const TPoint2Df& query, float search_radius_sqr,
                              std::vector<TPoint2Df>& results, std::vector<float>& out_dists_sqr,
                              std::vector<uint64_t>& resultIndicesOrIDs,
                              std::size_t maxPoints) const {
    several(surface(), query, orAll(maxPoints), search_radius_sqr, results, out_dists_sqr,
            resultIndicesOrIDs);
}

}  // namespace akimap
