// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <akimap/Ray.h>
#include "grid/BlockGrid.h"

#include <optional>
#include <vector>

namespace akimap::bench {

/** Parameters that BGKOctoMap and BGKOctoMap-L share. */
struct BgkOptions {
    double resolution = 0.05;         ///< side of a cell [m]
    double max_range = 8;             ///< longer rays are dropped [m]
    double downsampling = 0.05;       ///< side of the voxels that thin the samples [m]
    double kernel_length = 0.2;       ///< where the kernel ends [m]
    double kernel_variance = 1;       ///< the kernel's height
    double free_step = 0.5;           ///< between free samples along a ray [m]
    double prior = 0.001;             ///< of alpha and of beta
    double free_threshold = 0.3;      ///< cells with a lower occupancy are free
    double occupied_threshold = 0.7;  ///< cells with a higher one are occupied
    double variance_threshold = 100;  ///< cells of higher variance are neither
    /** Smaller sums of kernels from one block are left out: in LA3DM what single precision makes
     * zero or less, a kernel below about 5e-8. */
    double min_evidence = 5e-8;
};

/** The map of BGKOctoMap and BGKOctoMap-L (Doherty et al., T-RO 2019): test-data octrees, blocks of
 * 4 x 4 x 4 cells (depth 3) centred on multiples of their side. A block gets evidence from samples
 * in itself and in its six face neighbours. Siblings all free or all occupied are merged for good;
 * the merged leaf keeps the first one's evidence. */
class BgkBlocks {
 public:
    /** A line segment of one occupancy; a point if both ends are the same [m]. */
    struct Sample {
        std::array<double, 3> begin, end;
        bool occupied;
    };

    explicit BgkBlocks(const BgkOptions& options) : options_(options) {}

    /** A sample counts once in each block that one of `places` lies in. Those of one block have to
     * follow each other. */
    void add(const Sample& sample, const std::vector<std::array<double, 3>>& places);
    /** Updates the map with the samples added, and forgets them. */
    void update();

    [[nodiscard]] std::optional<double> occupancy(double x, double y, double z) const;

 private:
    /** Cells [first, first + count) of the block's Morton order, count = 1, 8 or 64. */
    struct Leaf {
        uint8_t first, count;
        bool touched;
        float alpha, beta;
    };
    using Leaves = std::vector<Leaf>;
    enum class State { unknown, free, occupied };

    [[nodiscard]] CellIndex cellAt(const std::array<double, 3>& p) const;
    [[nodiscard]] State state(const Leaf& leaf) const;
    void predict(const CellIndex& block, Leaves& leaves) const;
    void merge(Leaves& leaves, int count) const;

    BgkOptions options_;
    KeyTable index_;  // block -> its place in blocks_
    std::vector<Leaves> blocks_;

    std::vector<Sample> samples_;  // of one scan
    KeyTable data_index_;          // block -> its place in data_
    std::vector<CellIndex> data_blocks_;
    std::vector<std::vector<uint32_t>> data_;  // the block's samples
};

}  // namespace akimap::bench
