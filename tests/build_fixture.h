// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

// Logs for `akimap build` to read, and a fixture that runs it.
#include <akimap/AkiMap.h>
#include <gtest/gtest.h>
#include <mrpt/img/CImage.h>
#include <mrpt/io/CFileGZOutputStream.h>
#include <mrpt/io/CFileOutputStream.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/obs/CRawlog.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>
#include <mrpt/serialization/CArchive.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "run_program.h"

namespace build_tests {

using namespace mrpt::obs;
using akimap::AkiMap;
using mrpt::poses::CPose3D;
using Objects = std::vector<mrpt::serialization::CSerializable::Ptr>;

constexpr int kScans = 5;
constexpr double kStart = 1700000000;  // [s]

/** Scans are 0.25 s apart, and the robot goes 0.5 m in that time. */
inline double timeOf(int scan) {
    return kStart + 0.25 * scan;
}
inline CPose3D poseOf(int scan) {
    return CPose3D(0.5 * scan, 0, 0, 0, 0, 0);
}

/** A wall 2 m ahead of the sensor. */
inline CObservationPointCloud::Ptr wall(int scan, const std::string& label = "lidar") {
    auto cloud = mrpt::maps::CSimplePointsMap::Create();
    for (int i = -8; i <= 8; i++)
        for (int j = -8; j <= 8; j++)
            cloud->insertPointFast(2, 0.06f * static_cast<float>(i), 0.06f * static_cast<float>(j));
    auto observation = CObservationPointCloud::Create();
    observation->pointcloud = cloud;
    observation->sensorPose = CPose3D(0.25, 0, 1, 0, 0, 0);
    observation->timestamp = mrpt::Clock::fromDouble(timeOf(scan));
    observation->sensorLabel = label;
    return observation;
}

template <class Observation>
typename Observation::Ptr atTimeOf(int scan) {
    auto observation = Observation::Create();
    observation->timestamp = mrpt::Clock::fromDouble(timeOf(scan));
    return observation;
}

inline CObservationRobotPose::Ptr robotPose(int scan, const CPose3D& pose) {
    auto observation = atTimeOf<CObservationRobotPose>(scan);
    observation->pose.mean = pose;
    return observation;
}

inline CObservationOdometry::Ptr odometry(int scan) {
    auto observation = atTimeOf<CObservationOdometry>(scan);
    observation->odometry = mrpt::poses::CPose2D(poseOf(scan));
    return observation;
}

inline Objects walls() {
    Objects objects;
    for (int i = 0; i < kScans; i++) objects.push_back(wall(i));
    return objects;
}

inline void writePlain(const std::string& file, const Objects& objects) {
    mrpt::io::CFileOutputStream out(file);
    auto archive = mrpt::serialization::archiveFrom(out);
    for (const auto& object : objects) archive << *object;
}
inline void writeGz(const std::string& file, const Objects& objects) {
    mrpt::io::CFileGZOutputStream out(file);
    auto archive = mrpt::serialization::archiveFrom(out);
    for (const auto& object : objects) archive << *object;
}

inline std::string asciiPcd(const std::string& points, int count) {
    return "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH " + std::to_string(count) +
           "\nHEIGHT 1\nVIEWPOINT 0 0 1 1 0 0 0\nDATA ascii\n" + points;
}

/** Stands for the bytes of a map, and prints better. */
inline std::string fingerprint(const std::string& map_file) {
    const std::string bytes = readText(map_file);
    return std::to_string(bytes.size()) + " bytes, hash " +
           std::to_string(std::hash<std::string>()(bytes));
}

inline bool holds(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

class Build : public ::testing::Test {
 protected:
    std::string file(const std::string& name) const { return folder.file(name); }
    std::string write(const std::string& name, const std::string& text) const {
        writeText(file(name), text);
        return file(name);
    }
    std::string plain(const std::string& name, const Objects& objects) const {
        writePlain(file(name), objects);
        return file(name);
    }
    /** The right trajectory, from scan `first` to scan `last`. */
    std::string trajectory(int first = 0, int last = kScans - 1) const {
        std::string text = "# time x y z qx qy qz qw\n";
        for (int i = first; i <= last; i++) {
            char line[100];
            std::snprintf(line, sizeof line, "%.6f %.3f 0 0 0 0 0 1\n", timeOf(i), poseOf(i).x());
            text += line;
        }
        return write("t.tum", text);
    }

    ::Run build(const std::string& arguments) const {
        return runProgram("build " + arguments + " -o " + file("m.akimap") + " --json " +
                          file("m.json"));
    }
    /** Builds, expects success, and returns the fingerprint of the map. */
    std::string buildMap(const std::string& arguments) const {
        const auto run = build(arguments);
        EXPECT_EQ(run.exit, 0) << arguments << ": " << run.err;
        return run.exit == 0 ? fingerprint(file("m.akimap")) : "";
    }
    nlohmann::json json() const { return nlohmann::json::parse(readText(file("m.json"))); }

    /** Expects a refusal on one line that holds all parts, which the JSON holds too if the command
     * line was right, and an older map left as it was. */
    void expectRefused(const std::string& arguments, const std::vector<std::string>& parts) const {
        write("m.akimap", "an older map");
        std::filesystem::remove(file("m.json"));
        const auto count = [&] {
            using Files = std::filesystem::directory_iterator;
            return std::distance(Files(folder.path()), Files());
        };
        const auto before = count();
        const auto run = build(arguments);
        EXPECT_NE(run.exit, 0) << arguments;
        EXPECT_LT(run.exit, 128) << arguments << ": died of a signal";
        EXPECT_EQ(run.out, "");
        ASSERT_FALSE(run.err.empty()) << arguments;
        const std::string last = run.err.substr(run.err.rfind('\n', run.err.size() - 2) + 1);
        for (const std::string& part : parts)
            EXPECT_TRUE(holds(last, part)) << arguments << "\n" << run.err << "lacks " << part;
        EXPECT_EQ(readText(file("m.akimap")), "an older map");
        if (std::filesystem::exists(file("m.json"))) {
            const std::string error = json()["error"];
            EXPECT_TRUE(holds(last, error)) << last << "is not " << error;
            std::filesystem::remove(file("m.json"));
        }
        EXPECT_EQ(count(), before) << arguments << " left a file behind";
    }

    /** The map of the walls, made without the program. */
    std::string expectedMap(int scans = kScans) const {
        AkiMap map;
        for (int i = 0; i < scans; i++) map.insertObservation(*wall(i), poseOf(i));
        map.saveToFile(file("expected.akimap"));
        return fingerprint(file("expected.akimap"));
    }
    TemporaryFolder folder;
};

}  // namespace build_tests
