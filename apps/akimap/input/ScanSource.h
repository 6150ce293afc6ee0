// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <akimap/Ray.h>
#include <mrpt/obs/CObservation.h>
#include <mrpt/poses/CPose3D.h>

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "input/RobotPath.h"

namespace akimap::app {

/** One scan on its way into the map: an observation with its robot's pose, or bare rays. */
struct Scan {
    mrpt::obs::CObservation::Ptr observation;  ///< null for bare rays
    mrpt::poses::CPose3D robot_pose;           ///< in the map, at the observation's time
    std::shared_ptr<const RobotPath> motion;   ///< the robot's around that time; null: it stands
    std::vector<Ray> rays;                     ///< [m] map frame
};

/** What the sources passed over. */
struct SkippedScans {
    uint64_t outside_trajectory = 0;           ///< no robot pose at their time
    uint64_t other_label = 0;                  ///< not of the wanted sensor
    std::map<std::string, uint64_t> unusable;  ///< by class, of which no map can be made
};

struct InputOptions {
    std::shared_ptr<const RobotPath> trajectory;  ///< robot poses for rawlogs, before their own
    double max_gap = 0.5;                         ///< [s] largest gap bridged between robot poses
    std::string only_label;  ///< take observations of this sensor only; empty: of all
    bool partial = false;    ///< take what is whole of a rawlog cut at its end
    std::function<void(const std::string&)> warn;  ///< gets one line
};

/** A file of scans. Opening one reads it through, to find robot poses and refuse it early. */
class ScanSource {
 public:
    /** Gets a scan and returns whether it wants more. */
    using TakeScan = std::function<bool(Scan&)>;

    explicit ScanSource(std::string file) : file_(std::move(file)) {}
    virtual ~ScanSource() = default;
    ScanSource(const ScanSource&) = delete;
    ScanSource& operator=(const ScanSource&) = delete;

    [[nodiscard]] const std::string& file() const { return file_; }
    /** Scans that forEachScan() will give if asked for all. */
    [[nodiscard]] virtual std::size_t scanCount() const = 0;
    /** Sensor labels seen on usable observations. */
    [[nodiscard]] virtual std::set<std::string> labels() const { return {}; }

    /** Gives the scans in the file's order, holding one at a time, until `take` returns false.
     * \exception std::runtime_error naming the file */
    virtual void forEachScan(const TakeScan& take, SkippedScans& skipped) = 0;

 private:
    std::string file_;
};

struct FollowOptions;

/** Opens a .rawlog that is still being written: see FollowSource.
 * \exception std::runtime_error naming the file */
[[nodiscard]] std::unique_ptr<ScanSource> followSource(const std::string& file,
                                                       const InputOptions& options,
                                                       const FollowOptions& follow);

/** Opens a file by its extension: .rawlog, .simplemap or .pcd.
 * \exception std::runtime_error naming the file */
[[nodiscard]] std::unique_ptr<ScanSource> openSource(const std::string& file,
                                                     const InputOptions& options);

}  // namespace akimap::app
