// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "simulation/files.h"

#include <mrpt/core/Clock.h>
#include <mrpt/core/format.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/obs/CObservationVelodyneScan.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>
#include <mrpt/serialization/CArchive.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <system_error>

#include "akimap/output/binary_tree.h"
#include "support/AtomicFile.h"
#include "support/gz.h"
#include "support/stream.h"

namespace fs = std::filesystem;

namespace akimap::app {

using mrpt::poses::CPose3D;

namespace {

/** Calls write(archive) on a gz file. */
template <class Write>
void writeCompressed(const AtomicFile& file, Write&& write) {
    writeGz(file.path(), [&](GzWriter& gz) {
        auto archive = mrpt::serialization::archiveFrom(gz);
        write(archive);
    });
}

/** Almost certain: a covariance of zero can't be inverted, as some readers do. */
mrpt::poses::CPose3DPDFGaussian certain(const CPose3D& pose) {
    constexpr double kVariance = 1e-8;  // (0.1 mm)^2 and (0.1 mrad)^2
    mrpt::math::CMatrixDouble66 covariance;
    covariance.setDiagonal(6, kVariance);
    return {pose, covariance};
}

mrpt::obs::CObservationRobotPose poseObservation(const TimedPose& at) {
    mrpt::obs::CObservationRobotPose obs;
    obs.sensorLabel = "ROBOT_POSE";
    obs.timestamp = mrpt::Clock::fromDouble(at.time);
    obs.pose = certain(at.pose);
    return obs;
}

void writeRawlog(const SimulatedDrive& drive, bool with_poses, const AtomicFile& file) {
    auto pose = drive.trajectory.keyframes().begin();
    const auto last = with_poses ? drive.trajectory.keyframes().end() : pose;
    writeCompressed(file, [&](mrpt::serialization::CArchive& archive) {
        for (const SimulatedScan& scan : drive.scans) {
            for (; pose != last && pose->time <= scan.time; ++pose)
                archive << poseObservation(*pose);
            archive << *scan.observation;
        }
        for (; pose != last; ++pose) archive << poseObservation(*pose);
    });
}

void writeTrajectory(const Trajectory& trajectory, const AtomicFile& file) {
    std::ofstream out = openForWriting(file.path());
    out << "# time x y z qx qy qz qw\n";
    for (const auto& [time, pose] : trajectory.keyframes()) {
        mrpt::math::CQuaternionDouble q;
        pose.getAsQuaternion(q);
        out << mrpt::format("%.6f %.9f %.9f %.9f %.9f %.9f %.9f %.9f\n", time, pose.x(), pose.y(),
                            pose.z(), q.x(), q.y(), q.z(), q.r());
    }
    closeWritten(out);
}

/** A copy with its points made: MRPT's own maps take no range images or packets as they are. */
mrpt::obs::CObservation::Ptr withPoints(const mrpt::obs::CObservation& obs) {
    const auto copy =
        std::dynamic_pointer_cast<mrpt::obs::CObservation>(obs.duplicateGetSmartPtr());
    if (auto* depth = dynamic_cast<mrpt::obs::CObservation3DRangeScan*>(copy.get()))
        depth->unprojectInto(*depth);
    if (auto* velodyne = dynamic_cast<mrpt::obs::CObservationVelodyneScan*>(copy.get())) {
        mrpt::obs::CObservationVelodyneScan::TGeneratePointCloudParameters parameters;
        parameters.generatePerPointTimestamp = true;
        velodyne->generatePointCloud(parameters);
    }
    return copy;
}

void writeSimplemap(const SimulatedDrive& drive, const AtomicFile& file) {
    mrpt::maps::CSimpleMap map;
    for (const SimulatedScan& scan : drive.scans) {
        const auto frame = mrpt::obs::CSensoryFrame::Create();
        frame->insert(withPoints(*scan.observation));
        const mrpt::poses::CPose3DPDF::Ptr pose =
            std::make_shared<mrpt::poses::CPose3DPDFGaussian>(certain(scan.robot_pose));
        map.insert(pose, frame);
    }
    writeCompressed(file, [&](mrpt::serialization::CArchive& archive) { archive << map; });
}

void writeTruth(const octomap::OcTree& truth, const AtomicFile& file) {
    octomap::OcTree pruned(truth);
    pruned.prune();
    std::ofstream out = openForWriting(file.path());
    writeBinaryTree(pruned, out);
    closeWritten(out);
}

/** Puts the file's name before what went wrong. */
template <class Write>
void naming(const AtomicFile& file, Write&& write) {
    try {
        write();
    } catch (const std::exception& e) {
        throwCannotWrite(file.target(), e.what());
    }
}

}  // namespace

DriveFiles::DriveFiles(const std::string& folder)
    : rawlog(fs::path(folder) / "scene.rawlog"),
      trajectory(fs::path(folder) / "trajectory.tum"),
      simplemap(fs::path(folder) / "scene.simplemap"),
      truth(fs::path(folder) / "truth.bt"),
      true_trajectory(fs::path(folder) / "true_trajectory.tum") {}

DriveFiles prepareFolder(const std::string& folder) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) throw std::runtime_error("cannot create '" + folder + "': " + error.message());
    DriveFiles files(folder);
    for (const std::string& file :
         {files.rawlog, files.trajectory, files.simplemap, files.truth, files.true_trajectory})
        AtomicFile::checkWritable(file);
    return files;
}

void writeDrive(const SimulatedDrive& drive, const octomap::OcTree& truth, const DriveFiles& files,
                bool with_poses) {
    AtomicFile rawlog(files.rawlog), trajectory(files.trajectory), simplemap(files.simplemap),
        truth_file(files.truth), true_trajectory(files.true_trajectory);
    naming(rawlog, [&] { writeRawlog(drive, with_poses, rawlog); });
    naming(trajectory, [&] { writeTrajectory(drive.trajectory, trajectory); });
    naming(simplemap, [&] { writeSimplemap(drive, simplemap); });
    naming(truth_file, [&] { writeTruth(truth, truth_file); });
    naming(true_trajectory, [&] { writeTrajectory(drive.true_trajectory, true_trajectory); });
    for (AtomicFile* file : {&rawlog, &trajectory, &simplemap, &truth_file, &true_trajectory})
        file->commit();
}

}  // namespace akimap::app
