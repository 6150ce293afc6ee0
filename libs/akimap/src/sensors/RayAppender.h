// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <akimap/Ray.h>
#include <mrpt/poses/CPose3D.h>

#include <vector>

namespace akimap {

/** Appends rays from one sensor pose to points in the sensor's frame. */
class RayMaker {
 public:
    RayMaker(const mrpt::poses::CPose3D& sensor_in_map, std::vector<Ray>& rays, bool with_free)
        : pose_(sensor_in_map),
          origin_{pose_.x(), pose_.y(), pose_.z()},
          rays_(rays),
          with_free_(with_free) {}
    /** Whether beams without a return are wanted. */
    [[nodiscard]] bool withFree() const { return with_free_; }
    void add(double x, double y, double z, bool hit = true) {
        Ray r{origin_, {}, hit};
        pose_.composePoint(x, y, z, r.end[0], r.end[1], r.end[2]);
        rays_.push_back(r);
    }

 private:
    mrpt::poses::CPose3D pose_;
    std::array<double, 3> origin_;
    std::vector<Ray>& rays_;
    bool with_free_;
};

}  // namespace akimap
