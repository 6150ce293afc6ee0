// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
// Logs that are damaged, claim what they do not hold, or name files that are not theirs.
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <sys/stat.h>

#include <random>

#include "build_fixture.h"
#include "input/CheckedLog.h"
#include "input/ObjectReader.h"
#include "mapping/build_report.h"
#include "support/gz.h"

namespace {

using namespace build_tests;
using akimap::app::CheckedLog;
using akimap::app::ExternalFiles;

class HostileLogs : public Build {
 protected:
    /** Why the log is refused; empty if it is taken, and then it is read to its end. */
    static std::string refusal(const std::string& log,
                               ExternalFiles external = ExternalFiles::beside_log) {
        try {
            akimap::app::ObjectReader reader(CheckedLog(log, external));
            while (reader.next()) {
            }
            return "";
        } catch (const std::runtime_error& e) {
            EXPECT_EQ(std::string(e.what()).rfind(log, 0), 0u) << e.what();
            EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos) << e.what();
            return e.what();
        }
    }
    static CObservation3DRangeScan::Ptr depth(int rows) {
        constexpr int kColumns = 7;
        auto o = atTimeOf<CObservation3DRangeScan>(0);
        o->hasRangeImage = true, o->range_is_depth = true, o->rangeUnits = 0.001f;
        o->rangeImage_setSize(rows, kColumns);
        o->rangeImage.fill(1500);
        o->cameraParams.nrows = static_cast<uint32_t>(rows), o->cameraParams.ncols = kColumns;
        o->cameraParams.setIntrinsicParamsFromValues(30, 30, 16, 12);
        return o;
    }
    static CObservation3DRangeScan::Ptr points(std::size_t n) {
        auto o = atTimeOf<CObservation3DRangeScan>(0);
        o->hasPoints3D = true;
        o->resizePoints3DVectors(n);
        for (std::size_t i = 0; i < n; i++) o->points3D_x[i] = static_cast<float>(i);
        return o;
    }
    static CObservation2DRangeScan::Ptr laser(std::size_t n) {
        auto o = atTimeOf<CObservation2DRangeScan>(0);
        o->resizeScan(n);
        for (std::size_t i = 0; i < n; i++) o->setScanRange(i, 2), o->setScanRangeValidity(i, true);
        return o;
    }
    static CObservationPointCloud::Ptr cloud(std::size_t n) {
        auto points = mrpt::maps::CSimplePointsMap::Create();
        for (std::size_t i = 0; i < n; i++) points->insertPointFast(2, static_cast<float>(i), 0);
        auto o = atTimeOf<CObservationPointCloud>(0);
        o->pointcloud = points;
        return o;
    }
    static CActionCollection::Ptr action() {
        CActionRobotMovement2D movement;
        movement.computeFromOdometry(mrpt::poses::CPose2D(0.1, 0, 0), {});
        auto actions = CActionCollection::Create();
        actions->insert(movement);
        return actions;
    }
    /** Of every class whose reading has crashed; small, so that most bits matter. */
    static Objects mixedLog() {
        auto frame = CSensoryFrame::Create();
        frame->insert(laser(9));
        return {depth(5), points(8), action(), frame, cloud(6), laser(7), depth(5)};
    }
    static mrpt::maps::CSimpleMap::Ptr keyframes() {
        auto map = mrpt::maps::CSimpleMap::Create();
        auto frame = CSensoryFrame::Create();
        frame->insert(depth(4));
        frame->insert(cloud(5));
        map->insert(mrpt::poses::CPose3DPDFGaussian::Create(), frame);
        return map;
    }
    /** A cloud whose points are said to be in that file. */
    std::string logOfCloudIn(const std::string& name) {
        auto cloud = atTimeOf<CObservationPointCloud>(0);
        cloud->setAsExternalStorage(name,
                                    CObservationPointCloud::ExternalStorageFormat::PlainTextFile);
        return plain("external.rawlog", {cloud});
    }
};

std::string unpacked(const std::string& log) {
    akimap::GzReader gz(log);
    std::string bytes(1 << 20, '\0');
    bytes.resize(gz.readSome(bytes.data(), bytes.size()));
    return bytes;
}

std::string withBitFlipped(std::string bytes, std::size_t bit) {
    bytes[bit / 8] = static_cast<char>(bytes[bit / 8] ^ 1 << bit % 8);
    return bytes;
}

/** Puts `word`, little endian, in the place of the first time that the old one is behind `mark`. */
std::string withWord(std::string bytes, uint32_t old, uint32_t word) {
    const auto text = [](uint32_t v) {
        std::string t;
        for (int i = 0; i < 4; i++) t += static_cast<char>(v >> 8 * i);
        return t;
    };
    const auto at = bytes.find(text(old));
    EXPECT_NE(at, std::string::npos);
    return bytes.replace(at, 4, text(word));
}

}  // namespace

TEST_F(HostileLogs, AreTakenAsTheyAreRecorded) {
    EXPECT_EQ(refusal(plain("l.rawlog", mixedLog())), "");
    EXPECT_EQ(refusal(plain("l.simplemap", {keyframes()})), "");
}

TEST_F(HostileLogs, AnyFlippedBitOfAGzLogIsFoundOrChangesNothing) {
    writeGz(file("whole.rawlog"), mixedLog());
    const std::string whole = readText(file("whole.rawlog"));
    constexpr std::size_t kHead = 10;  // of gz: time, name of the system, which mean nothing
    const std::string content = unpacked(file("whole.rawlog"));
    for (std::size_t bit = 8 * kHead; bit < 8 * whole.size(); bit += 23) {
        const std::string log = write("l.rawlog", withBitFlipped(whole, bit));
        if (refusal(log).empty()) {
            EXPECT_EQ(unpacked(log), content) << "bit " << bit;
        }
    }
}

TEST_F(HostileLogs, PlainOnesAreRefusedOrReadWithoutHarm) {
    const std::vector<std::string> logs{readText(plain("l.rawlog", mixedLog())),
                                        readText(plain("l.simplemap", {keyframes()}))};
    std::mt19937 random(1);
    std::size_t refused = 0;
    for (const std::string& whole : logs)
        for (int round = 0; round < 300; round++)
            refused +=
                !refusal(write("f.rawlog", withBitFlipped(whole, random() % (8 * whole.size()))))
                     .empty();
    EXPECT_GT(refused, 20u);
}

TEST_F(HostileLogs, ClaimsAreNotBelieved) {
    const auto expectRefusedAs = [&](const std::string& bytes) {
        const auto before = akimap::app::peakMemoryBytes();
        EXPECT_NE(refusal(write("c.rawlog", bytes)), "");
        EXPECT_LT(akimap::app::peakMemoryBytes() - before, 20000000u);
    };
    const std::string image = readText(plain("l.rawlog", {depth(24), depth(24)}));
    for (const uint32_t rows : {65536u, 600000000u, 0x80000000u, 0xffffffffu})
        expectRefusedAs(withWord(image, 24, rows));
    const std::string ranges = readText(plain("l.rawlog", {laser(181), laser(181)}));
    const std::string points3d = readText(plain("l.rawlog", {points(300), points(300)}));
    const std::string clouds = readText(plain("l.rawlog", {cloud(301), cloud(301)}));
    for (const uint32_t count : {1000000000u, 0xffffffffu}) {
        expectRefusedAs(withWord(ranges, 181, count));
        expectRefusedAs(withWord(points3d, 300, count));
        expectRefusedAs(withWord(clouds, 301, count));
    }
}

TEST_F(HostileLogs, WhatMrptTakesToBeThereMustBe) {
    const std::string log = readText(plain("l.rawlog", {action()}));
    const std::string name = "CActionRobotMovement2D";  // of the only action
    const auto at = log.find(name);
    ASSERT_NE(at, std::string::npos);
    const auto begin = log.rfind(static_cast<char>(0x80 | (name.size() + 11)), at);
    ASSERT_NE(begin, std::string::npos);
    const std::string null = log.substr(0, begin) + "\x87nullptr\x88\x88";
    const std::string why = refusal(write("n.rawlog", null));
    EXPECT_TRUE(holds(why, "n.rawlog: object 1: damaged: ")) << why;
}

TEST_F(HostileLogs, ExternalFilesAreNotLookedForOutsideTheirFolder) {
    const TemporaryFolder elsewhere;
    const std::string outside = elsewhere.file("cloud.txt");
    writeText(outside, "1 2 3\n4 5 6\n");
    std::filesystem::create_directory(file("external_Images"));
    writeText(file("external_Images/cloud.txt"), "1 2 3\n4 5 6\n");
    writeText(file("near.txt"), "1 2 3\n4 5 6\n");
    std::filesystem::create_symlink(outside, file("external_Images/link.txt"));

    EXPECT_EQ(refusal(logOfCloudIn("cloud.txt")), "");
    EXPECT_EQ(refusal(logOfCloudIn("../near.txt")), "");
    EXPECT_EQ(refusal(logOfCloudIn(file("near.txt"))), "");
    const std::string up = std::filesystem::relative(outside, file("external_Images")).string();
    for (const std::string& name :
         {outside, up, std::string("link.txt"), std::string("/etc/shadow")}) {
        const std::string log = logOfCloudIn(name), why = refusal(log);
        EXPECT_TRUE(holds(why, "which is not in the log's folder")) << name << ": " << why;
        expectRefused(log, {"external.rawlog: object 1: its data are in "});
        if (name != "/etc/shadow") {
            EXPECT_EQ(refusal(log, ExternalFiles::anywhere), "") << name;
        }
    }
    EXPECT_EQ(buildMap(logOfCloudIn(outside) + " --allow-external"),
              buildMap(logOfCloudIn("cloud.txt")));
}

TEST_F(HostileLogs, ExternalFilesAreRegularFiles) {
    std::filesystem::create_directory(file("external_Images"));
    ASSERT_EQ(mkfifo(file("external_Images/pipe").c_str(), 0600), 0);
    for (const char* name : {"pipe", "/dev/zero", "/dev/random"}) {
        const std::string why = refusal(logOfCloudIn(name), ExternalFiles::anywhere);
        EXPECT_TRUE(holds(why, "which is no regular file")) << name << ": " << why;
    }
}
