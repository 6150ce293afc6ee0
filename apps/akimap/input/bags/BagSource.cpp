// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "input/bags/BagSource.h"

#include <rosbag/view.h>

#include <stdexcept>

#include "input/bags/BagPoses.h"
#include "input/bags/bag_messages.h"
#include "input/clouds/place_cloud.h"
#include "input/files.h"

namespace akimap::app {

namespace {

using mrpt::poses::CPose3D;
using rosbag::MessageInstance;
using Time = mrpt::Clock::time_point;

BagPoses readPosesOf(const std::string& file, const InputOptions& options) {
    requireReadable(file);
    try {
        return BagPoses(file, options);
    } catch (const rosbag::BagException& e) {
        throw std::runtime_error(file + ": no ROS 1 bag, or damaged: " + e.what());
    } catch (const std::exception& e) {
        throw std::runtime_error(file + ": " + e.what());
    }
}

class BagSource : public ScanSource {
 public:
    BagSource(const std::string& file, const InputOptions& options)
        : ScanSource(file), options_(options), poses_(readPosesOf(file, options)) {
        warnOfPoses();
    }

    [[nodiscard]] std::size_t scanCount() const override { return poses_.covered(); }
    [[nodiscard]] std::optional<std::size_t> uncoveredCount() const override {
        return poses_.uncovered();
    }
    [[nodiscard]] std::set<std::string> labels() const override { return poses_.topics(); }
    [[nodiscard]] std::string how() const override { return poses_.how(); }

    void forEachScan(const TakeScan& take, SkippedScans& skipped) override {
        rosbag::Bag bag(file(), rosbag::bagmode::Read);
        rosbag::View view(bag);
        for (const MessageInstance& m : view) {
            if (!isScanMessage(m)) continue;
            if (!options_.only_label.empty() && m.getTopic() != options_.only_label) {
                skipped.other_label++;
                continue;
            }
            std::optional<Scan> scan = scanOf(m, skipped);
            if (!scan)
                skipped.outside_trajectory++;
            else if (!take(*scan))
                return;
        }
    }

 private:
    void warnOfPoses() {
        if (poses_.topics().size() > 1 && options_.only_label.empty()) {
            std::string names;
            for (const std::string& topic : poses_.topics())
                names += (names.empty() ? "" : ", ") + topic;
            options_.warn(file() + ": scans of all topics are taken, " + names +
                          "; --only TOPIC takes one");
        }
        if (poses_.how().empty() && poses_.covered() > 1)
            options_.warn(file() +
                          ": no tf, odometry or poses in it, and no --poses: all its scans are "
                          "taken from one fixed pose");
    }

    /** Empty where there is no pose. */
    std::optional<Scan> scanOf(const MessageInstance& m, SkippedScans& skipped) const {
        const SeenScan seen = seenOf(m);
        const auto body = poses_.bodyAt(seen.frame, seen.time);
        if (!body) return std::nullopt;
        Scan scan;
        scan.robot_pose = *body;
        scan.time = seen.time;
        const CPose3D on_body = poses_.sensorOnBody(seen.frame);
        if (const auto cloud = m.instantiate<sensor_msgs::PointCloud2>()) {
            scan.sensor_pose = on_body;
            placeCloud(scan, cloudOf(*cloud), seen, skipped);
        } else if (const auto laser = m.instantiate<sensor_msgs::LaserScan>()) {
            setObservation(scan, laserOf(*laser), on_body, m.getTopic());
        } else {
            const auto camera = poses_.cameras().find(seen.frame);
            if (camera == poses_.cameras().end())
                throw std::runtime_error(m.getTopic() + ": no camera_info for its frame " +
                                         seen.frame);
            const auto image = m.instantiate<sensor_msgs::Image>();
            setObservation(scan, depthOf(*image, camera->second), on_body, m.getTopic());
        }
        return scan;
    }

    template <class Observation>
    static void setObservation(Scan& scan, const std::shared_ptr<Observation>& observation,
                               const CPose3D& on_body, const std::string& topic) {
        observation->sensorPose = on_body + observation->sensorPose;
        observation->sensorLabel = topic;
        scan.observation = observation;
    }

    void placeCloud(Scan& scan, const Cloud& cloud, const SeenScan& seen,
                    SkippedScans& skipped) const {
        if (poses_.isMap(seen.frame))
            return placeBare(scan, poses_.inMap(cloud, seen.frame), CloudFrame::map);
        if (!options_.deskew || cloud.time.empty() || !poses_.moves(seen.frame))
            return placeBare(scan, cloud, CloudFrame::sensor);
        const auto sensor_at = [&](Time time) {
            auto pose = poses_.bodyAt(seen.frame, time);
            if (pose) pose = *pose + scan.sensor_pose;
            return pose;
        };
        placeMoving(scan, cloud, sensor_at, skipped);
    }

    InputOptions options_;
    BagPoses poses_;
};

}  // namespace

std::unique_ptr<ScanSource> openBag(const std::string& file, const InputOptions& options) {
    return std::make_unique<BagSource>(file, options);
}

std::string bagReaderName() {
    return "by librosbag_storage";
}

}  // namespace akimap::app
