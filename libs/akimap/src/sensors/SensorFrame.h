// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <akimap/Ray.h>
#include <mrpt/poses/CPose3D.h>

namespace akimap {

/** Places points of a sensor's frame in the map: the pose's matrix is made once. */
class SensorFrame {
 public:
    explicit SensorFrame(const mrpt::poses::CPose3D& sensor_in_map)
        : origin_{sensor_in_map.x(), sensor_in_map.y(), sensor_in_map.z()} {
        const auto& R = sensor_in_map.getRotationMatrix();
        for (std::size_t i = 0; i < 3; i++)
            for (std::size_t j = 0; j < 3; j++)
                R_[i][j] = R(static_cast<int>(i), static_cast<int>(j));
    }
    [[nodiscard]] Ray rayTo(double x, double y, double z, bool hit = true) const {
        Ray r{origin_, {}, hit};
        for (std::size_t i = 0; i < 3; i++)
            r.end[i] = R_[i][0] * x + R_[i][1] * y + R_[i][2] * z + origin_[i];
        return r;
    }

 private:
    std::array<double, 3> origin_;
    std::array<std::array<double, 3>, 3> R_{};
};

}  // namespace akimap
