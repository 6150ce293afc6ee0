// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <nanoflann.hpp>
#include <optional>
#include <vector>

namespace akimap {

/** A point that a search found. */
struct Neighbor {
    uint32_t index;      ///< of the point
    float sqr_distance;  ///< in the square of the points' unit
};

/** Points as nanoflann reads them. */
struct Coordinates {
    std::array<const std::vector<float>*, 3> axes;
    [[nodiscard]] std::size_t kdtree_get_point_count() const { return axes[0]->size(); }
    [[nodiscard]] float kdtree_get_pt(std::size_t i, std::size_t axis) const {
        return (*axes[axis])[i];
    }
    template <class Box>
    bool kdtree_get_bbox(Box&) const {
        return false;
    }
};

/** Nearest neighbours on the first axes of the points. nanoflann renamed its result and parameter
 * types in 1.5: the results are gathered by our own, which both versions take.
 * Concurrent searches are safe. */
template <int kDimensions>
class KdTree {
 public:
    explicit KdTree(const Coordinates& points) : size_(points.kdtree_get_point_count()) {
        if (size_)  // the constructor builds the index
            index_.emplace(kDimensions, points, nanoflann::KDTreeSingleIndexAdaptorParams(8));
    }

    [[nodiscard]] std::optional<Neighbor> nearest(const float* query) const {
        One found;
        search(found, query);
        return found.full() ? std::optional(found.best) : std::nullopt;
    }
    [[nodiscard]] std::vector<Neighbor> nearest(const float* query, std::size_t count,
                                                float max_sqr_distance) const {
        Some found{std::min(count, size_), max_sqr_distance, {}};
        if (found.count > 0) search(found, query);
        found.sort();
        return std::move(found.neighbors);
    }

 private:
    static constexpr float kFar = std::numeric_limits<float>::max();

    struct One {
        using DistanceType = float;  // asked for from nanoflann 1.5 on
        Neighbor best{0, kFar};
        [[nodiscard]] std::size_t size() const { return full(); }
        [[nodiscard]] bool full() const { return best.sqr_distance < kFar; }
        [[nodiscard]] bool empty() const { return !full(); }
        [[nodiscard]] float worstDist() const { return best.sqr_distance; }
        bool addPoint(float sqr_distance, uint32_t index) {
            if (sqr_distance < best.sqr_distance) best = {index, sqr_distance};
            return true;
        }
        void sort() {}
    };
    /** The nearest ones, the farthest of them on top of a heap. */
    struct Some {
        using DistanceType = float;
        std::size_t count;
        float limit;
        std::vector<Neighbor> neighbors;
        static bool nearer(const Neighbor& a, const Neighbor& b) {
            return a.sqr_distance < b.sqr_distance ||
                   (a.sqr_distance == b.sqr_distance && a.index < b.index);
        }
        [[nodiscard]] std::size_t size() const { return neighbors.size(); }
        [[nodiscard]] bool full() const { return size() == count; }
        [[nodiscard]] bool empty() const { return neighbors.empty(); }
        [[nodiscard]] float worstDist() const {
            return full() ? std::min(limit, neighbors.front().sqr_distance) : limit;
        }
        bool addPoint(float sqr_distance, uint32_t index) {
            if (!(sqr_distance < worstDist())) return true;
            if (full()) std::pop_heap(neighbors.begin(), neighbors.end(), nearer);
            if (full()) neighbors.pop_back();
            neighbors.push_back({index, sqr_distance});
            std::push_heap(neighbors.begin(), neighbors.end(), nearer);
            return true;
        }
        void sort() { std::sort(neighbors.begin(), neighbors.end(), nearer); }
    };

    template <class Found>
    void search(Found& found, const float* query) const {
        const bool finite =
            std::all_of(query, query + kDimensions, [](float v) { return std::isfinite(v); });
        if (!index_ || !finite) return;
#if NANOFLANN_VERSION >= 0x150
        index_->findNeighbors(found, query, nanoflann::SearchParameters(0, false));
#else
        index_->findNeighbors(found, query, nanoflann::SearchParams(32, 0, false));
#endif
    }

    using Metric = nanoflann::L2_Simple_Adaptor<float, Coordinates>;
    std::size_t size_;
    std::optional<nanoflann::KDTreeSingleIndexAdaptor<Metric, Coordinates, kDimensions, uint32_t>>
        index_;
};

}  // namespace akimap
