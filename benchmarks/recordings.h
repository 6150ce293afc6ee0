// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <akimap/Ray.h>
#include <mrpt/poses/CPose3D.h>

#include <string>
#include <vector>

namespace akimap::bench {

/** Real and published recordings, as benchmarks/data.sh lays them out in $AKIMAP_DATA: each scan's
 * returns in the map frame, [m], and where its sensor was. */
struct PosedScan {
    mrpt::poses::CPose3D sensor;  ///< in the map
    std::vector<Ray> rays;        ///< in the map, from the sensor
};

/** Depth frames: `camera-intrinsics.txt` (3 x 3), and for each frame `NAME.depth.png` (16 bits, mm;
 * 0 and 65535: nothing) and `NAME.pose.txt` (4 x 4, camera to map; z ahead, y down). Every
 * fourth pixel of every fourth row, farther than 0.3 m.
 * \return no scans if the folder is not there
 * \exception std::runtime_error naming the file that is missing or damaged */
[[nodiscard]] std::vector<PosedScan> depthFrames(const std::string& folder);

/** `scan_*.pcd` in the sensor's frame, and `poses_kitti.txt`: a line for each, the first three rows
 * of its sensor's pose in the map. \return and \exception as depthFrames() */
[[nodiscard]] std::vector<PosedScan> posedClouds(const std::string& folder);

/** With all origins so much higher. LA3DM's VIEWPOINT is 0.3 m too low: as it stands, rays graze
 * the floor, and a map is rewarded for ignoring what they saw. \param metres [m] */
[[nodiscard]] std::vector<std::vector<Ray>> raised(std::vector<std::vector<Ray>> scans,
                                                   double metres);
inline constexpr double kLa3dmTooLow = 0.3;  ///< [m]

[[nodiscard]] std::vector<std::vector<Ray>> raysOf(const std::vector<PosedScan>& scans);

/** A folder of $AKIMAP_DATA; beside none, one that is not there. */
[[nodiscard]] std::string dataFolder(const std::string& name);

}  // namespace akimap::bench
