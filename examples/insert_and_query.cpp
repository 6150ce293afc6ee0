// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers

// One scan of a wall goes into a map; then the map is asked what it knows.
#include <akimap/AkiMap.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CObservationPointCloud.h>

#include <iostream>

namespace {

/** A wall 2 m ahead of the sensor, 2 m wide and high. */
mrpt::obs::CObservationPointCloud scanOfWall() {
    auto points = mrpt::maps::CSimplePointsMap::Create();
    for (int i = -50; i <= 50; i++)
        for (int j = -50; j <= 50; j++)
            points->insertPointFast(2.02f, 0.02f * static_cast<float>(i),
                                    0.02f * static_cast<float>(j));
    mrpt::obs::CObservationPointCloud scan;
    scan.pointcloud = points;
    scan.sensorPose = mrpt::poses::CPose3D(0, 0, 1.2, 0, 0, 0);  // on the robot
    return scan;
}

void ask(const akimap::AkiMap& map, const char* where, double x, double y, double z) {
    const auto occupancy = map.occupancy(x, y, z);
    std::cout << where << ": ";
    if (occupancy)
        std::cout << (*occupancy > 0.5 ? "occupied" : "free") << ", P(occupied) = " << *occupancy;
    else
        std::cout << "unknown";
    std::cout << "\n";
}

}  // namespace

int main() {
    akimap::AkiMap map(0.05);             // cells of 5 cm
    map.insertionOptions.max_range = 10;  // [m]
    const mrpt::poses::CPose3D robot(1, 0, 0, 0, 0, 0);
    if (!map.insertObservation(scanOfWall(), robot)) return 1;

    std::cout << map.asString() << "\n";
    ask(map, "on the wall", 3.02, 0, 1.2);
    ask(map, "in front of it", 2.0, 0, 1.2);
    ask(map, "behind it", 5.0, 0, 1.2);

    std::size_t occupied = 0, free = 0;
    map.forEachCell(
        [&](const akimap::Cell& cell) { (cell.state.occupancy() > 0.5 ? occupied : free)++; });
    std::cout << occupied << " cells occupied, " << free << " free\n";
}
