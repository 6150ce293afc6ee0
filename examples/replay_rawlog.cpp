// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers

// Replays a rawlog of either format into a map, posed by its odometry alone.
// Usage: replay_rawlog RAWLOG OUT.akimap. For poses from elsewhere see `akimap build`.
#include <akimap/AkiMap.h>
#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CRawlog.h>
#include <mrpt/serialization/CArchive.h>

#include <iostream>

namespace {

void replay(const std::string& rawlog, akimap::AkiMap& map) {
    mrpt::io::CFileGZInputStream file;
    if (!file.open(rawlog)) throw std::runtime_error("can't read " + rawlog);
    auto archive = mrpt::serialization::archiveFrom(file);

    mrpt::poses::CPose2D robot;
    mrpt::obs::CActionCollection::Ptr actions;
    mrpt::obs::CSensoryFrame::Ptr frame;
    mrpt::obs::CObservation::Ptr observation;
    std::size_t entry = 0;
    while (mrpt::obs::CRawlog::getActionObservationPairOrObservation(archive, actions, frame,
                                                                     observation, entry)) {
        if (actions)
            if (const auto move = actions->getBestMovementEstimation())
                robot = robot + move->poseChange->getMeanVal();
        if (const auto odo =
                std::dynamic_pointer_cast<mrpt::obs::CObservationOdometry>(observation))
            robot = odo->odometry;
        if (observation) map.insertObservation(*observation, mrpt::poses::CPose3D(robot));
        if (frame) frame->insertObservationsInto(map, mrpt::poses::CPose3D(robot));
    }
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 3) {
        std::cerr << "usage: replay_rawlog RAWLOG OUT.akimap\n";
        return 2;
    }
    try {
        akimap::AkiMap map(0.1);  // cells of 10 cm
        replay(argv[1], map);
        map.saveToFile(argv[2]);
        std::cout << map.stats().scans << " scans: " << map.asString() << "\n";
    } catch (const std::exception& e) {
        std::cerr << "replay_rawlog: " << e.what() << "\n";
        return 1;
    }
}
