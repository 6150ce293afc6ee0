// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers

// Maps a room and then finds, by MRPT's ICP, from where in it a second scan was taken.
#include <akimap/AkiMap.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/poses/CPose3DPDF.h>
#include <mrpt/slam/CICP.h>

#include <iostream>

namespace {

using mrpt::poses::CPose3D;

/** The walls and the floor of a room of 6 x 4 x 3 m, from a sensor somewhere in it. */
mrpt::maps::CSimplePointsMap::Ptr scanRoom(const CPose3D& sensor) {
    auto scan = mrpt::maps::CSimplePointsMap::Create();
    const auto see = [&](double x, double y, double z) {
        const auto p = sensor.inverseComposePoint({x, y, z});
        scan->insertPoint(mrpt::math::TPoint3D(p));
    };
    for (double z = 0; z <= 3; z += 0.04) {
        for (double x = -3; x <= 3; x += 0.04) see(x, -2, z), see(x, 2, z);
        for (double y = -2; y <= 2; y += 0.04) see(-3, y, z), see(3, y, z);
    }
    for (double x = -3; x <= 3; x += 0.04)
        for (double y = -2; y <= 2; y += 0.04) see(x, y, 0);
    return scan;
}

}  // namespace

int main() {
    mrpt::obs::CObservationPointCloud first;
    first.sensorPose = CPose3D(0, 0, 1.5, 0, 0, 0);
    first.pointcloud = scanRoom(first.sensorPose);
    akimap::AkiMap map(0.05);
    map.insertObservation(first);

    const CPose3D truth(0.2, -0.1, 1.4, 0.1, 0.02, -0.03);  // x y z [m], yaw pitch roll [rad]
    const auto scan = scanRoom(truth);

    mrpt::slam::CICP icp;
    icp.options.maxIterations = 200;
    icp.options.thresholdDist = 0.3;          // [m]
    icp.options.smallestThresholdDist = 0.1;  // [m]
    mrpt::slam::CICP::TReturnInfo info;
    const CPose3D guess = first.sensorPose;
    const auto found = icp.Align3D(&map, scan.get(), guess, info)->getMeanVal();

    const CPose3D error = found - truth;
    std::cout << "pose " << found.asString() << "\nafter " << info.nIterations << " iterations, "
              << error.norm() << " m from the truth; " << info.goodness * 100 << " % matched\n";
    return error.norm() < 0.02 ? 0 : 1;
}
