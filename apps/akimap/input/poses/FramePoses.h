// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <mrpt/core/Clock.h>
#include <mrpt/poses/CPose3D.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "input/poses/RobotPath.h"

namespace akimap::app {

/** Where and when each of several files was recorded. */
struct FramePoses {
    std::vector<std::optional<mrpt::poses::CPose3D>> poses;  ///< empty: not covered
    std::vector<mrpt::Clock::time_point> times;              ///< of each file; empty: not known
    std::shared_ptr<const RobotPath> path;  ///< the poses over time, if they have times
    std::string how;                        ///< "by the order of the files", ...
};

/** Gives each file its pose.
 *  - A folder of pose files: that with the same name up to its first dot, else the same number.
 *  - Poses with times: at the files' times. These come from `times_file`, from names that are times
 *    (1305031102.1602.png, 1403636579763555584.bin), or from numbers in names that are each the
 * time of a pose; else, if there are as many, in order.
 *  - Other poses: in order, and there must be as many.
 * \param files in order
 * \param poses a file for readPoses(), or a folder of such; empty: only the times are looked for
 * \param times_file lines of a time [s], and maybe more; empty: none
 * \exception std::runtime_error naming the file */
[[nodiscard]] FramePoses matchPoses(const std::vector<std::string>& files, const std::string& poses,
                                    const std::string& times_file, double max_gap);

}  // namespace akimap::app
