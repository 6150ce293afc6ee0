// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <mrpt/poses/CPose3D.h>

#include <string>
#include <vector>

namespace akimap::app {

/** What a file of poses holds, in its order (of vertices: in that of their numbers). */
struct PoseList {
    std::string file, form;
    std::vector<mrpt::poses::CPose3D> poses;  ///< [m, rad] in the map
    std::vector<double> times;                ///< [s], of each; empty: the form has none
};

/** Reads poses in the form that their lines show:
 *  - TUM: time x y z qx qy qz qw;
 *  - KITTI: 12 numbers, the first three rows of a 4 x 4 matrix;
 *  - 4 x 4 matrices, a row or a matrix a line;
 *  - Open3D's .log: three whole numbers, then four lines of a matrix;
 *  - g2o: VERTEX_SE3:QUAT and VERTEX_SE2, other lines are passed over.
 * Blank lines and those that begin with # are skipped.
 * \exception std::runtime_error naming the file and the line */
[[nodiscard]] PoseList readPoses(const std::string& file);

/** A pose given on a command line: x,y,z,yaw,pitch,roll [m, degrees], 12 or 16 numbers of a matrix,
 * or a file of such; of KITTI's calib.txt, its line Tr.
 * \param option its name, for errors. \exception std::runtime_error */
[[nodiscard]] mrpt::poses::CPose3D poseArgument(const std::string& option, const std::string& text);

}  // namespace akimap::app
