// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace akimap::app {

/** A PCD file's VIEWPOINT: the pose of the sensor, by convention. */
struct PcdViewpoint {
    std::array<double, 3> translation{};         ///< [m]
    std::array<double, 4> rotation{1, 0, 0, 0};  ///< quaternion, its real part first

    [[nodiscard]] bool isRotated() const;
};

/** The points of one file, as it has them. */
struct Cloud {
    std::vector<std::array<double, 3>> points;  ///< [m]; finite or not
    // One for each point, or none:
    std::vector<float> intensity;
    std::vector<double> time;  ///< [s], of the epoch or since any moment of the scan
    std::optional<PcdViewpoint> viewpoint;
};

/** Extensions of the files that readCloud() takes, in lower case, each with its dot. */
[[nodiscard]] const std::vector<std::string>& cloudExtensions();

/** The file's extension in lower case, if it is that of a cloud; else empty. */
[[nodiscard]] std::string cloudExtension(const std::string& file);

/** Reads a .pcd, .ply, .bin (KITTI: x y z intensity, floats), .txt, .csv or .xyz file.
 * \exception std::runtime_error naming the file and the line or byte */
[[nodiscard]] Cloud readCloud(const std::string& file);

/** Reads no more than the header. \return the VIEWPOINT of a .pcd file, if it has one
 * \exception std::runtime_error as readCloud(), for what the header shows */
[[nodiscard]] std::optional<PcdViewpoint> peekCloud(const std::string& file);

}  // namespace akimap::app
