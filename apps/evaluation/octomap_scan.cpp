// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "evaluation/octomap_scan.h"

#include <mrpt/maps/CSimplePointsMap.h>

namespace akimap::app {

PointCloudScan asPointCloud(const std::vector<Ray>& rays) {
    PointCloudScan s;
    s.observation.pointcloud = mrpt::maps::CSimplePointsMap::Create();
    if (rays.empty()) return s;
    const auto& o = rays.front().origin;
    s.robot = mrpt::poses::CPose3D(o[0], o[1], o[2], 0, 0, 0);
    for (const Ray& r : rays)
        s.observation.pointcloud->insertPointFast(static_cast<float>(r.end[0] - o[0]),
                                                  static_cast<float>(r.end[1] - o[1]),
                                                  static_cast<float>(r.end[2] - o[2]));
    return s;
}

}  // namespace akimap::app
