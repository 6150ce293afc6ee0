// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <akimap/Ray.h>

#include <array>
#include <vector>

namespace akimap::app {

/** Where the rays of a scan lie in a picture: as a camera sees them if they all lie within 75
 * degrees of their mean direction, else by azimuth and elevation, all round. Up is the map's z; for
 * a camera that looks along z it is -y, as in maps that begin in a camera's frame. */
class ScanProjection {
 public:
    /** \pre there are rays, all of them with a length */
    explicit ScanProjection(const std::vector<Ray>& rays);

    struct Place {
        double x, y;  ///< in [0, 1], y downwards; outside for the few rays that stray
    };
    [[nodiscard]] Place operator()(const Ray& ray) const;
    [[nodiscard]] bool isPanorama() const { return is_panorama_; }
    [[nodiscard]] double aspect() const { return width_ / height_; }  ///< width / height

 private:
    using Vector = std::array<double, 3>;
    [[nodiscard]] Place flat(const Ray& ray) const;

    Vector forward_{}, right_{}, up_{};
    bool is_panorama_;
    double left_ = 0, top_ = 0, width_ = 1, height_ = 1;
};

}  // namespace akimap::app
