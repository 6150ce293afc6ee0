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
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "input/external_files.h"
#include "input/poses/RobotPath.h"

namespace akimap::app {

/** One scan on its way into the map: an observation with its robot's pose, or bare rays. */
struct Scan {
    mrpt::obs::CObservation::Ptr observation;  ///< null for bare rays
    mrpt::poses::CPose3D robot_pose;           ///< in the map, at the observation's time
    std::shared_ptr<const RobotPath> motion;   ///< the robot's around that time; null: it stands
    std::vector<Ray> rays;                     ///< [m] map frame
    // Of bare rays:
    mrpt::poses::CPose3D sensor_pose{};  ///< on the robot
    std::vector<float> intensity{};      ///< of each ray, or none
    std::optional<mrpt::Clock::time_point> time{};
};

/** \return when the scan was taken, if it is known */
[[nodiscard]] inline std::optional<mrpt::Clock::time_point> timeOf(const Scan& scan) {
    if (!scan.observation) return scan.time;
    if (scan.observation->timestamp == INVALID_TIMESTAMP) return std::nullopt;
    return scan.observation->timestamp;
}

/** Which frame the points of a cloud are in. */
enum class CloudFrame { map, sensor };

/** What the sources passed over. */
struct SkippedScans {
    uint64_t outside_trajectory = 0;           ///< no robot pose at their time
    uint64_t other_label = 0;                  ///< not of the wanted sensor
    uint64_t points_outside_trajectory = 0;    ///< of clouds whose points have times
    std::map<std::string, uint64_t> unusable;  ///< by class, of which no map can be made
};

struct InputOptions {
    std::shared_ptr<const RobotPath> trajectory;  ///< robot poses for rawlogs, before their own
    double max_gap = 0.5;                         ///< [s] largest gap bridged between robot poses
    std::string poses;  ///< file or folder of poses for clouds and depth images; empty: none
    std::string times;  ///< file of their times; empty: in their names, if anywhere
    mrpt::poses::CPose3D extrinsic;   ///< of their sensor on what the poses are of
    std::optional<CloudFrame> frame;  ///< of clouds; empty: as poses and VIEWPOINTs suggest
    bool deskew = true;      ///< take clouds' points from where the sensor was at their times
    std::string only_label;  ///< take observations of this sensor only; empty: of all
    bool partial = false;    ///< take what is whole of a rawlog cut at its end
    ExternalFiles external_files = ExternalFiles::beside_log;  ///< of rawlogs and simplemaps
    std::function<void(const std::string&)> warn;              ///< gets one line
};

/** Scans of a file, or of a list of files. Opening one reads it through, to find robot poses and
 * refuse it early. */
class ScanSource {
 public:
    /** Gets a scan and returns whether it wants more. */
    using TakeScan = std::function<bool(Scan&)>;

    explicit ScanSource(std::string file) : file_(std::move(file)) {}
    virtual ~ScanSource() = default;
    ScanSource(const ScanSource&) = delete;
    ScanSource& operator=(const ScanSource&) = delete;

    /** The file, or that of a list which is being read. */
    [[nodiscard]] const std::string& file() const { return file_; }
    /** Scans that forEachScan() will give if asked for all. */
    [[nodiscard]] virtual std::size_t scanCount() const = 0;
    /** How scans and poses of a list of files were brought together; empty of other sources. */
    [[nodiscard]] virtual std::string how() const { return ""; }
    /** Of a log: scans at whose time there is no pose. */
    [[nodiscard]] virtual std::optional<std::size_t> uncoveredCount() const { return {}; }
    /** Sensor labels seen on usable observations. */
    [[nodiscard]] virtual std::set<std::string> labels() const { return {}; }

    /** Gives the scans in the file's order, holding one at a time, until `take` returns false.
     * \exception std::runtime_error naming the file */
    virtual void forEachScan(const TakeScan& take, SkippedScans& skipped) = 0;

 protected:
    void nowReading(const std::string& file) { file_ = file; }

 private:
    std::string file_;
};

struct FollowOptions;

/** Opens a .rawlog that is still being written: see FollowSource.
 * \exception std::runtime_error naming the file */
[[nodiscard]] std::unique_ptr<ScanSource> followSource(const std::string& file,
                                                       const InputOptions& options,
                                                       const FollowOptions& follow);

/** Opens a file by its extension: .rawlog, .simplemap or .bag.
 * \exception std::runtime_error naming the file */
[[nodiscard]] std::unique_ptr<ScanSource> openSource(const std::string& file,
                                                     const InputOptions& options);

}  // namespace akimap::app
