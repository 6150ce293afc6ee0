// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <octomap/OcTree.h>

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace akimap::app {

/** An axis-parallel box [m], its faces included. The default holds everything. */
struct Box {
    static constexpr double kFar = std::numeric_limits<double>::infinity();
    std::array<double, 3> min = {-kFar, -kFar, -kFar};
    std::array<double, 3> max = {kFar, kFar, kFar};
};

/** \param text `x0,y0,z0,x1,y1,z1` [m]
 * \exception std::runtime_error unless it is six finite numbers, each minimum below its maximum */
[[nodiscard]] Box parseBox(const std::string& text);

/** The true occupancy of a place: what an OctoMap tree knows, leaf by leaf. */
struct Truth {
    /** A cube of `size` cells a side, all of the same kind. Cell i covers
     * [i, i + 1) * resolution on each axis, as in AkiMap. */
    struct Leaf {
        std::array<int32_t, 3> first;  ///< the cell with the lowest indices
        int32_t size;                  ///< 1, or more for a pruned leaf
        bool occupied;
    };
    double resolution = 0;  ///< [m]
    std::vector<Leaf> leaves;

    /** Known cells whose centre lies in the box. */
    [[nodiscard]] double countCells(const Box& box) const;

    /** Calls visit(x, y, z, occupied) with the centre [m] of each known cell in the box; pruned
     * leaves are taken apart. */
    template <class Visitor>
    void forEachCell(const Box& box, Visitor&& visit) const {
        for (const Leaf& leaf : leaves) {
            const Range x = inside(leaf, box, 0), y = inside(leaf, box, 1),
                        z = inside(leaf, box, 2);
            for (int32_t k = z.begin; k < z.end; k++)
                for (int32_t j = y.begin; j < y.end; j++)
                    for (int32_t i = x.begin; i < x.end; i++)
                        visit(center(i), center(j), center(k), leaf.occupied);
        }
    }

 private:
    struct Range {
        int32_t begin, end;
    };
    [[nodiscard]] double center(int32_t i) const { return (i + 0.5) * resolution; }
    [[nodiscard]] Range inside(const Leaf& leaf, const Box& box, std::size_t axis) const;
};

/** Reads an OctoMap binary tree (.bt). Not with OctoMap's own reader, which prints to stderr and
 * recurses without bound into a damaged file.
 * \param what the file is called in errors
 * \exception std::runtime_error naming the file if it is missing, damaged or no such tree */
[[nodiscard]] Truth readTruth(const std::string& file, const std::string& what = "the truth");

/** Each leaf counts as occupied or free by the tree's own threshold. */
[[nodiscard]] Truth truthOf(const octomap::OcTree& tree);

}  // namespace akimap::app
