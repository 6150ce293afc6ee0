// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <memory>
#include <string>

#include "input/ScanSource.h"

namespace akimap::app {

/** Opens a ROS 1 bag: its PointCloud2, LaserScan and depth images are the scans, placed by
 * InputOptions::trajectory, else by tf, else by odometry.
 * \exception std::runtime_error naming the file; also if akimap was built without the reader */
[[nodiscard]] std::unique_ptr<ScanSource> openBag(const std::string& file,
                                                  const InputOptions& options);

/** The bag reader that akimap was built with; empty: none. */
[[nodiscard]] std::string bagReaderName();

}  // namespace akimap::app
