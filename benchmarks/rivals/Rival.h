// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <akimap/Ray.h>

#include <optional>
#include <vector>

namespace akimap::bench {

/** An occupancy map of another method, to compare with. One thread, deterministic. */
struct Rival {
    virtual ~Rival() = default;
    virtual void insert(const std::vector<Ray>& scan) = 0;
    /** Of the cell that holds (x, y, z) [m]; empty if the method never touched it. */
    [[nodiscard]] virtual std::optional<double> occupancy(double x, double y, double z) const = 0;
};

/** One ray per voxel of side `size` [m] that holds ray ends: the mean of those rays, as PCL's
 * VoxelGrid gives. In the order of each voxel's first ray. */
[[nodiscard]] std::vector<Ray> downsample(const std::vector<Ray>& rays, double size);

/** The distance of a ray's end from its origin [m]. */
[[nodiscard]] double length(const Ray& ray);

/** The point at the distance d [m] from a ray's origin towards its end. */
[[nodiscard]] std::array<double, 3> pointOn(const Ray& ray, double d);

}  // namespace akimap::bench
