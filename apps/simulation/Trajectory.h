// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <mrpt/poses/CPose3D.h>
#include <mrpt/poses/CPose3DInterpolator.h>

#include <vector>

#include "simulation/Scene.h"

namespace akimap::app {

/** The robot's pose in the map at a time [s since 1970]. */
struct TimedPose {
    double time;
    mrpt::poses::CPose3D pose;
};

/** The robot's motion: straight lines and constant turns (slerp) between its keyframes, so that
 * a reader who interpolates the keyframes in this way gets the motion itself. */
class Trajectory {
 public:
    Trajectory();
    /** Keyframes come in the order of time. */
    void add(double time, const mrpt::poses::CPose3D& pose);
    /** \param time  [s since 1970]
     * \exception std::out_of_range before the first or after the last keyframe */
    [[nodiscard]] mrpt::poses::CPose3D at(double time) const;
    [[nodiscard]] const std::vector<TimedPose>& keyframes() const { return keyframes_; }

 private:
    std::vector<TimedPose> keyframes_;
    mrpt::poses::CPose3DInterpolator interpolator_;
};

constexpr double kScanSeconds = 0.1;  ///< from a scan's first packet to its last

/** The drive through the scene's places: three scans at each, headings a third of a turn apart,
 * one scan a second. */
struct Drive {
    Trajectory trajectory;
    std::vector<double> scan_times;  ///< start of each scan [s since 1970]
};

/** \param moving  the robot drives 0.4 m and turns by 12 degrees during each scan, else it stands
 * \param seed  small random changes to where it stands and how it leans */
Drive makeDrive(const Scene& scene, bool moving, uint64_t seed);

}  // namespace akimap::app
