// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "input/scan_classes.h"

#include <akimap/AkiMap.h>
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRobotPose.h>

namespace akimap::app {

namespace {

template <class... Classes>
bool isAnyOf(const mrpt::obs::CObservation& observation) {
    return (... || (dynamic_cast<const Classes*>(&observation) != nullptr));
}

}  // namespace

bool isScan(const mrpt::obs::CObservation& observation) {
    static const AkiMap any_map;  // the map has a likelihood for just the classes that it inserts
    return any_map.canComputeObservationLikelihood(observation);
}

bool isWantedScan(const mrpt::obs::CObservation& observation, const std::string& only_label,
                  SkippedScans& skipped) {
    using namespace mrpt::obs;
    if (isAnyOf<CObservationComment, CObservationOdometry, CObservationRobotPose>(observation))
        return false;
    if (!isScan(observation)) {
        const std::string name = observation.GetRuntimeClass()->className;
        skipped.unusable[name.substr(name.rfind(':') + 1)]++;
        return false;
    }
    if (!only_label.empty() && observation.sensorLabel != only_label) {
        skipped.other_label++;
        return false;
    }
    return true;
}

std::string fixedPoseWarning(const std::string& log_file) {
    return log_file +
           ": no robot poses and no odometry in it, and no --poses: all its scans are taken from "
           "one fixed pose; if the sensor moved, --poses FILE (TUM) tells where it was";
}

}  // namespace akimap::app
