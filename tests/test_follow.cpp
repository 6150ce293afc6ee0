// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
//
// `akimap build` on logs as rawlog-grabber writes them, finished or still being written.
#include <fcntl.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationGPS.h>
#include <mrpt/obs/CObservationIMU.h>
#include <signal.h>

#include <chrono>
#include <thread>

#include "background.h"
#include "build_fixture.h"
#include "input/ObjectReader.h"

namespace {

using namespace build_tests;
using std::chrono::milliseconds;

/** Appends bytes in small pieces of changing size, each flushed, as a slow recorder would. */
void appendSlowly(const std::string& file, const std::string& bytes, size_t pieces) {
    std::ofstream out(file, std::ios::binary | std::ios::app);
    size_t at = 0;
    for (size_t i = 0; at < bytes.size(); i++) {
        const size_t size = 1 + bytes.size() / pieces * (1 + i % 3) / 2;
        out << bytes.substr(at, size) << std::flush;
        at += size;
        std::this_thread::sleep_for(milliseconds(5));
    }
}

class Follow : public Build {
 protected:
    std::string follow(const std::string& log, const std::string& map, const std::string& idle,
                       const std::string& more = "") const {
        return "build " + log + " -o " + map + " --json " + map + ".json --follow --idle " + idle +
               " " + more;
    }

    /** What a robot with a depth camera, a Velodyne, a laser scanner and some sensors without
     * points records in eight seconds of driving; its odometry lags a little. */
    Objects grabbed() const {
        const auto simulated = runProgram("simulate structured --sensor velodyne --moving -o " +
                                          folder.path().string());
        EXPECT_EQ(simulated.exit, 0) << simulated.err;
        Objects log{odometry(-1)};  // the Velodyne's first turn began before scan 0
        using namespace akimap::app;
        ObjectReader reader(CheckedLog(file("scene.rawlog"), ExternalFiles::beside_log));
        for (int i = 0; auto object = reader.next(); i++) {
            auto scan = std::dynamic_pointer_cast<CObservation>(object);
            if (!scan || i >= 8) continue;
            scan->timestamp = mrpt::Clock::fromDouble(timeOf(i) - 0.1);
            scan->sensorLabel = "VLP16";
            log.insert(log.end(),
                       {scan, atTimeOf<CObservationIMU>(i), depthImage(i), laser(i),
                        wall(i, "lidar_left"), atTimeOf<CObservationGPS>(i), odometry(i)});
        }
        for (int i = 8; i < 12; i++) log.push_back(odometry(i));
        return log;
    }

 private:
    CObservation::Ptr depthImage(int scan) const {
        const std::string images = file("grabbed_Images");
        std::filesystem::create_directory(images);
        auto depth = atTimeOf<CObservation3DRangeScan>(scan);
        depth->sensorLabel = "KINECT";
        depth->sensorPose = CPose3D(0, 0, 0.5, 0, 0, 0);
        depth->hasRangeImage = true;
        depth->rangeImage_setSize(24, 32);
        depth->rangeImage.fill(static_cast<uint16_t>(1500 + 100 * scan));
        depth->rangeUnits = 0.001f;
        depth->cameraParams.nrows = 24;
        depth->cameraParams.ncols = 32;
        depth->cameraParams.setIntrinsicParamsFromValues(30, 30, 16, 12);
        depth->rangeImage_convertToExternalStorage("depth" + std::to_string(scan) + ".bin",
                                                   images + "/");
        return depth;
    }
    static CObservation::Ptr laser(int scan) {
        auto laser = atTimeOf<CObservation2DRangeScan>(scan);
        laser->sensorLabel = "HOKUYO";
        laser->sensorPose = CPose3D(0.1, 0, 0.3, M_PI, 0, 0);
        laser->aperture = static_cast<float>(M_PI);
        laser->maxRange = 8;
        laser->resizeScanAndAssign(91, 2.5f, true);
        return laser;
    }
};

TEST_F(Follow, AGrabbersLogIsMappedAsAWholeAndWhileItIsWritten) {
    const Objects log = grabbed();
    writeGz(file("whole.rawlog.gz"), log);
    std::filesystem::copy(file("grabbed_Images"), file("whole_Images"));
    const std::string expected = buildMap(file("whole.rawlog.gz"));
    const auto counts = json();
    EXPECT_EQ(counts["scans"], 4 * 8) << "of each of the four sensors";
    EXPECT_EQ(counts["skipped_observations_CObservationIMU"], 8);
    EXPECT_EQ(counts["skipped_observations_CObservationGPS"], 8);
    EXPECT_EQ(counts["skipped_scans_trajectory"], 0);
    EXPECT_EQ(counts["skipped_packets_trajectory"], 0);
    EXPECT_GT(counts["points"], 8 * (24 * 32 + 91 + 17 * 17 + 1000));

    // Twice at a time: a gz file, cut wherever it happens, and a plain one.
    const std::string packed = readText(file("whole.rawlog.gz"));
    const std::string unpacked = readText(plain("whole.rawlog", log));
    std::vector<std::thread> writers;
    for (const char* name : {"packed", "unpacked"}) {
        write(std::string(name) + ".rawlog", "");
        std::filesystem::copy(file("grabbed_Images"), file(std::string(name) + "_Images"));
    }
    Background first(follow(file("packed.rawlog"), file("packed.akimap"), "4"), file("p"));
    Background second(follow(file("unpacked.rawlog"), file("unpacked.akimap"), "4"), file("u"));
    writers.emplace_back([&] { appendSlowly(file("packed.rawlog"), packed, 150); });
    writers.emplace_back([&] { appendSlowly(file("unpacked.rawlog"), unpacked, 150); });
    for (std::thread& writer : writers) writer.join();
    for (auto* program : {&first, &second}) {
        const auto run = program->wait();
        EXPECT_EQ(run.exit, 0) << run.err;
        EXPECT_EQ(run.err, "");
    }
    EXPECT_EQ(fingerprint(file("packed.akimap")), expected);
    EXPECT_EQ(fingerprint(file("unpacked.akimap")), expected);
}

TEST_F(Follow, ATrajectoryRobotPosesAndIncrementsGiveTheFinishedLogsMap) {
    Objects poses = walls(), frames;
    for (int i = 0; i < kScans; i++) poses.push_back(robotPose(i, poseOf(i)));
    for (int i = 0; i < kScans; i++) {
        CActionRobotMovement2D movement;
        movement.computeFromOdometry(
            mrpt::poses::CPose2D(i == 0 ? CPose3D() : poseOf(i) - poseOf(i - 1)), {});
        auto actions = CActionCollection::Create();
        actions->insert(movement);
        auto frame = CSensoryFrame::Create();
        frame->insert(wall(i));
        frames.insert(frames.end(), {actions, frame});
    }
    const std::string given = plain("given.rawlog", walls()) + " --trajectory " + trajectory();
    const std::string whole = expectedMap();
    Background a(follow(given, file("a.akimap"), "0.5"), file("a"));
    Background b(follow(plain("poses.rawlog", poses), file("b.akimap"), "2"), file("b"));
    Background c(follow(plain("frames.rawlog", frames), file("c.akimap"), "0.5"), file("c"));
    Background d(follow(file("given.rawlog"), file("d.akimap"), "0.5"), file("d"));
    for (auto* program : {&a, &b, &c}) EXPECT_EQ(program->wait().exit, 0);
    for (const char* map : {"a.akimap", "b.akimap", "c.akimap"})
        EXPECT_EQ(fingerprint(file(map)), whole) << map;
    const auto fixed = d.wait();
    EXPECT_EQ(fixed.exit, 0);
    EXPECT_TRUE(holds(fixed.err, "all its scans are taken from one fixed pose")) << fixed.err;
    EXPECT_EQ(fingerprint(file("d.akimap")), buildMap(file("given.rawlog")));
}

TEST_F(Follow, AnInterruptEndsItEarlyWithAWholeMap) {
    const std::string log = plain("l.rawlog", {wall(0), wall(1), wall(2)});
    const std::string half = readText(plain("next", {wall(3)}));
    const std::string bytes = readText(log) + half.substr(0, half.size() / 2);
    write("l.rawlog", bytes);
    Background program(follow(log, file("m.akimap"), "100", "--trajectory " + trajectory()),
                       file("m"));
    while (program.readingPosition(log) != static_cast<long>(bytes.size()))
        std::this_thread::sleep_for(milliseconds(20));
    std::this_thread::sleep_for(milliseconds(1000));  // for the insertions
    program.interrupt();
    const auto run = program.wait();
    EXPECT_EQ(run.exit, 0) << run.err;
    EXPECT_EQ(run.err, "");
    EXPECT_TRUE(holds(run.out, "cells")) << run.out;
    const std::string map = fingerprint(file("m.akimap"));
    EXPECT_TRUE(map == expectedMap(3) || map == expectedMap(2) || map == expectedMap(1));
}

TEST_F(Follow, HalfAnObjectAtTheEndIsLeftOutWithAWarning) {
    const std::string log = plain("l.rawlog", walls());
    const std::string bytes = readText(log);
    write("l.rawlog", bytes.substr(0, bytes.size() - 100));
    Background program(follow(log, file("m.akimap"), "0.5", "--trajectory " + trajectory()),
                       file("m"));
    const auto run = program.wait();
    EXPECT_EQ(run.exit, 0) << run.err;
    EXPECT_TRUE(holds(run.err, "warning: " + log + ": the file ends inside object 5")) << run.err;
    EXPECT_EQ(fingerprint(file("m.akimap")), expectedMap(kScans - 1));
}

TEST_F(Follow, WhatCanNotBeFollowedIsRefused) {
    const std::string quick = " --follow --idle 0.2";
    expectRefused(write("empty.rawlog", "") + quick, {"empty.rawlog: not a rawlog", "nothing"});
    expectRefused(file("none.rawlog") + quick, {"none.rawlog: no such file"});
    expectRefused(write("c.pcd", asciiPcd("2 0 1\n", 1)) + quick, {"c.pcd: not a .rawlog"});
    expectRefused(write("bad.rawlog", "this is not what MRPT writes") + quick,
                  {"bad.rawlog: object 1", "no MRPT data"});
    expectRefused(plain("l.rawlog", walls()) + " --follow --idle 0", {"--idle must be"});
    expectRefused(file("l.rawlog") + " --idle 3", {"--idle requires --follow"});
    writeGz(file("d.rawlog"), walls());
    std::string bytes = readText(file("d.rawlog"));
    for (size_t i = bytes.size() / 2; i < bytes.size() / 2 + 20; i++) bytes[i] = '\x55';
    expectRefused(write("d.rawlog", bytes) + quick, {"d.rawlog: object"});
}

}  // namespace
