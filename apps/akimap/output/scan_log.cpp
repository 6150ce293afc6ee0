// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "output/scan_log.h"

#include <mrpt/maps/CPointsMapXYZI.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>
#include <mrpt/serialization/CArchive.h>

#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "support/AtomicFile.h"
#include "support/gz.h"

namespace akimap::app {

namespace {

using mrpt::obs::CObservation;
using mrpt::poses::CPose3D;
using Time = mrpt::Clock::time_point;

/** \param place of the points, which the cloud's are relative to */
template <class Add>
void forEachPoint(const Scan& scan, const CPose3D& place, Add&& add) {
    for (std::size_t i = 0; i < scan.rays.size(); i++) {
        const auto& e = scan.rays[i].end;
        if (!std::isfinite(e[0] + e[1] + e[2])) continue;
        double x = 0, y = 0, z = 0;
        place.inverseComposePoint(e[0], e[1], e[2], x, y, z);
        add(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z), i);
    }
}

mrpt::maps::CPointsMap::Ptr pointsOf(const Scan& scan) {
    const CPose3D place = scan.robot_pose + scan.sensor_pose;
    if (scan.intensity.empty()) {
        auto points = mrpt::maps::CSimplePointsMap::Create();
        forEachPoint(scan, place, [&](float x, float y, float z, std::size_t) {
            points->insertPointFast(x, y, z);
        });
        return points;
    }
    auto points = mrpt::maps::CPointsMapXYZI::Create();
    std::size_t n = 0;
    forEachPoint(scan, place, [&](float x, float y, float z, std::size_t i) {
        points->insertPointFast(x, y, z);
        points->setPointIntensity(n++, scan.intensity[i]);
    });
    return points;
}

/** Times for scans that have none: a second apart. */
class Clock {
 public:
    Time next() { return mrpt::Clock::fromDouble(++seconds_); }

 private:
    double seconds_ = 0;
};

void writePose(GzWriter& out, Time time, const CPose3D& pose) {
    mrpt::obs::CObservationRobotPose at;
    at.timestamp = time;
    at.sensorLabel = "pose";
    at.pose.mean = pose;
    mrpt::serialization::archiveFrom(out) << at;
}

void writeRawlog(GzWriter& out, const GiveScans& give) {
    Clock clock;
    bool wrote_motion = false;
    give([&](const Scan& scan) {
        const CObservation::Ptr observation = observationOf(scan, clock.next());
        if (!scan.motion) writePose(out, observation->timestamp, scan.robot_pose);
        if (scan.motion && !wrote_motion)  // of packets the poses between scans matter too
            for (const RobotPath::Sample& sample : scan.motion->samples())
                writePose(out, sample.time, RobotPath::poseOf(sample));
        wrote_motion = wrote_motion || scan.motion;
        mrpt::serialization::archiveFrom(out) << *observation;
    });
}

void writeSimplemap(GzWriter& out, const GiveScans& give) {
    Clock clock;
    mrpt::maps::CSimpleMap map;
    give([&](const Scan& scan) {
        const auto frame = mrpt::obs::CSensoryFrame::Create();
        frame->insert(observationOf(scan, clock.next()));
        const mrpt::poses::CPose3DPDF::Ptr pose =
            mrpt::poses::CPose3DPDFGaussian::Create(scan.robot_pose);
        map.insert(pose, frame);
    });
    mrpt::serialization::archiveFrom(out) << map;
}

}  // namespace

CObservation::Ptr observationOf(const Scan& scan, Time fallback) {
    if (scan.observation) {
        if (scan.observation->timestamp == INVALID_TIMESTAMP)
            scan.observation->timestamp = fallback;
        return scan.observation;
    }
    auto cloud = mrpt::obs::CObservationPointCloud::Create();
    cloud->pointcloud = pointsOf(scan);
    cloud->sensorPose = scan.sensor_pose;
    cloud->sensorLabel = "cloud";
    cloud->timestamp = scan.time.value_or(fallback);
    return cloud;
}

void writeScanLog(const std::string& target, const GiveScans& give) {
    AtomicFile file(target);
    std::string failure;  // of the writing, not of the scans
    try {
        GzWriter gz(file.path(), failure);
        const bool is_rawlog = std::filesystem::path(target).extension() == ".rawlog";
        is_rawlog ? writeRawlog(gz, give) : writeSimplemap(gz, give);
        gz.close();
    } catch (const std::exception&) {
        if (!failure.empty()) throwCannotWrite(target, failure);
        throw;
    }
    file.commit();
}

}  // namespace akimap::app
