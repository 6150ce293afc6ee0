// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
//
// The readers of `akimap build`: trajectories, point clouds, and the objects of MRPT's files.
#include <gtest/gtest.h>
#include <mrpt/io/CFileGZOutputStream.h>
#include <mrpt/io/CFileOutputStream.h>
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/poses/CPose3DQuat.h>
#include <mrpt/serialization/CArchive.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "input/ObjectReader.h"
#include "input/clouds/PcdReader.h"
#include "input/clouds/lzf.h"
#include "input/poses/RobotPath.h"
#include "mapping/build_report.h"
#include "run_program.h"

namespace {

using namespace akimap::app;
using akimap::Ray;

mrpt::Clock::time_point at(double seconds) {
    return mrpt::Clock::fromDouble(seconds);
}

/** The message of what `act` throws; empty if it doesn't. */
template <class Act>
std::string refusal(Act&& act) {
    try {
        act();
        return "";
    } catch (const std::runtime_error& e) {
        return e.what();
    }
}

bool holds(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

class Inputs : public ::testing::Test {
 protected:
    std::string write(const std::string& name, const std::string& text) const {
        writeText(folder.file(name), text);
        return folder.file(name);
    }
    RobotPath path(const std::string& tum, double max_gap = 0.5) const {
        return RobotPath::loadTum(write("t.tum", tum), max_gap);
    }
    TemporaryFolder folder;
};

// Trajectories ----------------------------------------------------------------------------

using Trajectories = Inputs;

TEST_F(Trajectories, TumColumnsArePositionThenQuaternionWithItsRealPartLast) {
    // 90 degrees about z: the x axis of the robot looks along y of the map.
    const double h = std::sqrt(0.5);
    const auto pose = path("# time x y z qx qy qz qw\n\n100.5 1 2 3 0 0 " + std::to_string(h) +
                           " " + std::to_string(h) + "\r\n")
                          .at(at(100.5));
    ASSERT_TRUE(pose);
    EXPECT_NEAR(pose->x(), 1, 1e-9);
    EXPECT_NEAR(pose->y(), 2, 1e-9);
    EXPECT_NEAR(pose->z(), 3, 1e-9);
    EXPECT_NEAR(pose->yaw(), M_PI / 2, 1e-6);
    EXPECT_NEAR(pose->pitch(), 0, 1e-6);
    EXPECT_NEAR(pose->roll(), 0, 1e-6);
}

TEST_F(Trajectories, BetweenSamplesPositionIsLinearAndRotationASlerp) {
    // From looking along x to a turn of 120 degrees about (1,1,1), in one second.
    const auto track = path("10 0 0 0 0 0 0 1\n11 4 -2 1 .5 .5 .5 .5\n", 1);
    for (const double t : {0.25, 0.5, 0.9}) {
        const auto pose = track.at(at(10 + t));
        ASSERT_TRUE(pose);
        EXPECT_NEAR(pose->x(), 4 * t, 1e-5);
        EXPECT_NEAR(pose->y(), -2 * t, 1e-5);
        EXPECT_NEAR(pose->z(), t, 1e-5);
        const mrpt::poses::CPose3DQuat q(*pose);
        const double angle = 2 * std::acos(q.quat().r());
        EXPECT_NEAR(angle, t * 2 * M_PI / 3, 1e-5);
        EXPECT_NEAR(q.quat().x(), q.quat().y(), 1e-9);
        EXPECT_NEAR(q.quat().x(), q.quat().z(), 1e-9);
    }
}

TEST_F(Trajectories, TheShorterWayRoundIsTakenWhateverTheQuaternionsSign) {
    // 20 degrees apart about z, the second with its sign turned.
    const double s = std::sin(M_PI / 18), c = std::cos(M_PI / 18);
    const auto track = path(
        "0 0 0 0 0 0 0 1\n1 0 0 0 0 0 " + std::to_string(-s) + " " + std::to_string(-c) + "\n", 1);
    EXPECT_NEAR(track.at(at(0.5))->yaw(), M_PI / 18, 1e-5);
}

TEST_F(Trajectories, OutsideAndWithinGapsThereIsNoPose) {
    const auto track = path("1 0 0 0 0 0 0 1\n1.5 1 0 0 0 0 0 1\n3 2 0 0 0 0 0 1\n");
    EXPECT_FALSE(track.at(at(0.9)));
    EXPECT_TRUE(track.at(at(1)));
    EXPECT_TRUE(track.at(at(1.2)));
    EXPECT_FALSE(track.at(at(2))) << "1.5 s between the samples";
    EXPECT_TRUE(track.at(at(3))) << "a sample itself is no gap";
    EXPECT_FALSE(track.at(at(3.1)));
    EXPECT_TRUE(path("1 0 0 0 0 0 0 1\n1.5 1 0 0 0 0 0 1\n3 2 0 0 0 0 0 1\n", 1.5).at(at(2)));
}

TEST_F(Trajectories, ASampleStandsInForAMillisecond) {
    const auto track = path("1 7 0 0 0 0 0 1\n");
    ASSERT_TRUE(track.at(at(0.9995)));
    EXPECT_EQ(track.at(at(1.0005))->x(), 7);
    EXPECT_FALSE(track.at(at(1.002)));
}

TEST_F(Trajectories, OrderDoesNotMatterAndTheLastOfOneTimeIsKept) {
    const auto track = path("2 2 0 0 0 0 0 1\n1 1 0 0 0 0 0 1\n2 5 0 0 0 0 0 1\n", 2);
    EXPECT_EQ(track.samples().size(), 2u);
    EXPECT_NEAR(track.at(at(1.5))->x(), 3, 1e-5);
    EXPECT_EQ(track.at(at(2))->x(), 5);
}

TEST_F(Trajectories, WhatIsMalformedIsRefusedWithItsLine) {
    const std::string good = "# c\n1 0 0 0 0 0 0 1\n";
    const auto refused = [&](const std::string& line) {
        return refusal([&] { path(good + line + "\n"); });
    };
    EXPECT_TRUE(holds(refused("2 0 0 0 0 0 1"), "t.tum:3: expected 8 numbers"));
    EXPECT_TRUE(holds(refused("2 0 0 0 0 0 0 1 9"), "t.tum:3: expected 8 numbers"));
    EXPECT_TRUE(holds(refused("2 0 0 zero 0 0 0 1"), "t.tum:3: 'zero' is not a finite number"));
    EXPECT_TRUE(holds(refused("2 0 0 nan 0 0 0 1"), "t.tum:3: 'nan'"));
    EXPECT_TRUE(holds(refused("2 0 0 0 0 0 0 0"), "t.tum:3: qx qy qz qw"));
    EXPECT_TRUE(holds(refused("1600000000000000000 0 0 0 0 0 0 1"), "t.tum:3: "));
    EXPECT_TRUE(holds(refusal([&] { path("# only comments\n"); }), "t.tum: "));
    EXPECT_TRUE(holds(refusal([&] { RobotPath::loadTum(folder.file("none.tum"), 1); }),
                      "none.tum: no such file"));
    EXPECT_TRUE(holds(refusal([&] { RobotPath::loadTum(folder.path().string(), 1); }), "folder"));
}

// Point clouds ----------------------------------------------------------------------------

using PointClouds = Inputs;

std::string pcdHeader(const std::string& fields, const std::string& sizes, const std::string& types,
                      const std::string& counts, std::size_t points, const std::string& data) {
    const std::string n = std::to_string(points);
    return "# .PCD v0.7\nVERSION 0.7\nFIELDS " + fields + "\nSIZE " + sizes + "\nTYPE " + types +
           "\nCOUNT " + counts + "\nWIDTH " + n +
           "\nHEIGHT 1\nVIEWPOINT 0.5 -1 2 1 0 0 0\nPOINTS " + n + "\nDATA " + data + "\n";
}

template <class T>
void append(std::string& bytes, T value) {
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    bytes.append(raw, sizeof value);
}

/** Packs bytes as LZF literals only: what any decoder must take. */
std::string packLiterals(const std::string& bytes) {
    std::string packed;
    for (std::size_t i = 0; i < bytes.size(); i += 32) {
        const std::string run = bytes.substr(i, 32);
        packed += static_cast<char>(run.size() - 1);
        packed += run;
    }
    return packed;
}

void expectPoints(const std::vector<Ray>& rays) {
    ASSERT_EQ(rays.size(), 2u);
    for (const Ray& ray : rays) EXPECT_EQ(ray.origin, (std::array<double, 3>{0.5, -1, 2}));
    EXPECT_EQ(rays[0].end, (std::array<double, 3>{1.5, -2.25, 3}));
    EXPECT_EQ(rays[1].end, (std::array<double, 3>{0.125, 1e6, -4}));
}

TEST_F(PointClouds, AsciiWithOtherFieldsAmongTheCoordinates) {
    expectPoints(readPcd(write(
        "a.pcd", pcdHeader("z rgb y normal x", "4 4 4 4 8", "F U F F F", "1 1 1 3 1", 2, "ascii") +
                     "3 77 -2.25 0 0 1 1.5\n\n-4 77 1e6 0 0 1 +.125\r\n")));
}

TEST_F(PointClouds, BinaryOfMixedSizes) {
    std::string text =
        pcdHeader("label x pad y z", "2 4 1 8 4", "U F I F F", "1 1 3 1 1", 2, "binary");
    const double points[2][3] = {{1.5, -2.25, 3}, {0.125, 1e6, -4}};
    for (const auto& p : points) {
        append(text, uint16_t{7});
        append(text, static_cast<float>(p[0]));
        text += "abc";
        append(text, p[1]);
        append(text, static_cast<float>(p[2]));
    }
    expectPoints(readPcd(write("b.pcd", text)));
}

TEST_F(PointClouds, CompressedLiesFieldByField) {
    std::string data;
    for (const float x : {1.5f, 0.125f}) append(data, x);
    for (const float y : {-2.25f, 1e6f}) append(data, y);
    for (const uint8_t i : {uint8_t{1}, uint8_t{2}}) append(data, i);
    for (const float z : {3.f, -4.f}) append(data, z);
    const std::string packed = packLiterals(data);
    std::string text =
        pcdHeader("x y i z", "4 4 1 4", "F F U F", "1 1 1 1", 2, "binary_compressed");
    append(text, static_cast<uint32_t>(packed.size()));
    append(text, static_cast<uint32_t>(data.size()));
    expectPoints(readPcd(write("c.pcd", text + packed)));
}

TEST_F(PointClouds, LzfCopiesFromEarlierOutputEvenFromItself) {
    // "ab", then 6 bytes from 2 back, then a long copy (7 + 2 + 1 = 10 bytes) from 8 back.
    const std::vector<uint8_t> packed{1, 'a', 'b', 4 << 5, 1, 7 << 5, 1, 7};
    const auto bytes = unpackLzf(packed, 18);
    EXPECT_EQ(std::string(bytes.begin(), bytes.end()), std::string("ababababababababab"));
    EXPECT_NE(refusal([] {
                  (void)unpackLzf({1, 'a', 'b', 4 << 5, 2}, 8);
              }),
              "")
        << "before the start";
    EXPECT_NE(refusal([] { (void)unpackLzf({1, 'a', 'b', 4 << 5, 1}, 7); }), "") << "too much";
    EXPECT_NE(refusal([] { (void)unpackLzf({1, 'a', 'b'}, 3); }), "") << "too little";
    EXPECT_NE(refusal([] { (void)unpackLzf({9, 'a', 'b'}, 10); }), "") << "cut";
    EXPECT_NE(refusal([] { (void)unpackLzf({1, 'a', 'b'}, std::size_t{1} << 60); }), "");
}

TEST_F(PointClouds, WithoutViewpointRaysStartAtZeroAndNanStaysIn) {
    const auto rays = readPcd(write("n.pcd",
                                    "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 2\nHEIGHT 1\n"
                                    "DATA ascii\n1 2 3\nnan nan nan"));
    ASSERT_EQ(rays.size(), 2u);
    EXPECT_EQ(rays[0].origin, (std::array<double, 3>{0, 0, 0}));
    EXPECT_TRUE(std::isnan(rays[1].end[0]));
}

TEST_F(PointClouds, WhatIsMalformedIsRefusedWithItsLineOrByte) {
    const auto header = [](const std::string& data, std::size_t points = 2) {
        return pcdHeader("x y z", "4 4 4", "F F F", "1 1 1", points, data);
    };
    const auto refused = [&](const std::string& text) {
        return refusal([&] { (void)readPcd(write("m.pcd", text)); });
    };
    EXPECT_TRUE(holds(refused(header("ascii") + "1 2 3\n44 555\n"), "m.pcd: line 13: expected 3"));
    EXPECT_TRUE(holds(refused(header("ascii") + "1 2 3\n4 5 six\n"), "line 13: 'six'"));
    EXPECT_TRUE(holds(refused(header("ascii") + "1 2 3\n4 5 6\n7 8 9\n"), "line 14: more than"));
    EXPECT_TRUE(holds(refused(header("ascii") + "111 222 333\n"), "the data end at byte"));
    EXPECT_TRUE(holds(refused(header("binary") + "12345678901234567890123"), "byte "));
    EXPECT_TRUE(holds(refused(header("binary", 1000000000)), "need 12000000000 bytes"));
    EXPECT_TRUE(holds(refused(header("binary_compressed") + "1234"), "the data end at byte"));
    EXPECT_TRUE(holds(refused(header("octal")), "line 11: DATA"));
    EXPECT_TRUE(holds(refused("VERSION 0.7\nFIELDS x y z\n"), "line 3: no DATA line"));
    EXPECT_TRUE(holds(refused("no cloud at all\n"), "line 1: this is not a PCD file"));
    EXPECT_TRUE(holds(refused(""), "no DATA line"));
    EXPECT_TRUE(holds(refused(pcdHeader("x y", "4 4", "F F", "1 1", 1, "ascii")), "no field 'z'"));
    EXPECT_TRUE(holds(refused(pcdHeader("x y z", "4 4", "F F F", "1 1 1", 1, "ascii")), "line 4"));
    EXPECT_TRUE(holds(refused(pcdHeader("x y z", "4 4 3", "F F F", "1 1 1", 1, "ascii")), "'3'"));
    EXPECT_TRUE(holds(refused(pcdHeader("x y z", "4 4 4", "F F I", "1 1 1", 1, "ascii")), "'z'"));
    EXPECT_TRUE(
        holds(refusal([&] { (void)readPcd(folder.file("none.pcd")); }), "none.pcd: no such file"));
}

TEST_F(PointClouds, WidthTimesHeightDoesNotOverflow) {
    // 2^40 x 2^20 points of 16 bytes take 0 bytes, modulo 2^64.
    for (const char* data : {"ascii", "binary", "binary_compressed"}) {
        const std::string why = refusal([&] {
            (void)readPcd(write("w.pcd",
                                "FIELDS x y z i\nSIZE 4 4 4 4\nTYPE F F F F\nWIDTH 1099511627776\n"
                                "HEIGHT 1048576\nDATA " +
                                    std::string(data) + "\n"));
        });
        EXPECT_TRUE(holds(why, "w.pcd: line 4: WIDTH times HEIGHT")) << data << ": " << why;
    }
}

TEST_F(PointClouds, AHeaderThatClaimsMuchTakesNoMemory) {
    // Points of 120 kB, of which there are none: a buffer for 16384 of them would be 2 GB.
    const std::string text =
        "FIELDS x y z i\nSIZE 4 4 4 8\nTYPE F F F F\nCOUNT 1 1 1 15000\nPOINTS 0\nDATA binary\n";
    const auto before = peakMemoryBytes();
    EXPECT_TRUE(readPcd(write("h.pcd", text)).empty());
    EXPECT_LT(peakMemoryBytes() - before, 10000000u);
}

// MRPT's serialized objects ---------------------------------------------------------------

using Objects = Inputs;

/** Comments of very different lengths; returns the offset of the end of each. */
template <class Stream>
std::vector<uint64_t> writeObjects(Stream& stream, int count) {
    std::vector<uint64_t> ends;
    auto archive = mrpt::serialization::archiveFrom(stream);
    for (int i = 0; i < count; i++) {
        mrpt::obs::CObservationComment comment;
        comment.sensorLabel = "label";
        for (int n = 0; n < 25 * i; n++) comment.text += static_cast<char>('a' + n * n % 23);
        archive << comment;
        ends.push_back(stream.getPosition());
    }
    return ends;
}

/** Objects read before the end; -1 if it is a cut one, -2 if the file is refused as damaged. */
int countObjects(const std::string& file) {
    try {
        ObjectReader reader(CheckedLog(file, ExternalFiles::beside_log));
        int count = 0;
        while (reader.next()) count++;
        return count;
    } catch (const CutFile&) {
        return -1;
    } catch (const std::runtime_error&) {
        return -2;
    }
}

TEST_F(Objects, APlainFileEndsCleanlyJustBehindAnObject) {
    const std::string file = folder.file("plain");
    std::vector<uint64_t> ends;
    {
        mrpt::io::CFileOutputStream out(file);
        ends = writeObjects(out, 4);
    }
    const std::string whole = readText(file);
    ASSERT_EQ(whole.size(), ends.back());
    int expected = 0;
    for (std::size_t size = 0; size <= whole.size(); size++) {
        const bool at_end =
            static_cast<std::size_t>(expected) < ends.size() && size == ends[expected];
        if (at_end) expected++;
        const bool clean = size == 0 || at_end;
        ASSERT_EQ(countObjects(write("cut", whole.substr(0, size))), clean ? expected : -1)
            << "cut at byte " << size << " of " << whole.size();
    }
}

TEST_F(Objects, ACutGzFileIsNeverTakenForAWholeOne) {
    const std::string file = folder.file("packed");
    {
        mrpt::io::CFileGZOutputStream out(file);
        writeObjects(out, 4);
    }
    const std::string whole = readText(file);
    EXPECT_EQ(countObjects(file), 4);
    for (std::size_t size = 1; size < whole.size(); size++)
        ASSERT_EQ(countObjects(write("cut", whole.substr(0, size))), -1)
            << "cut at byte " << size << " of " << whole.size();
}

TEST_F(Objects, AppendedGzFilesAreWhole) {
    for (const char* name : {"one", "two"}) {
        mrpt::io::CFileGZOutputStream out(folder.file(name));
        writeObjects(out, 3);
    }
    const std::string one = readText(folder.file("one")), two = readText(folder.file("two"));
    EXPECT_EQ(countObjects(write("both", one + two)), 6);
    EXPECT_EQ(countObjects(folder.file("one")), 3);
    for (std::size_t size = 1; size < two.size(); size++)
        ASSERT_EQ(countObjects(write("cut", one + two.substr(0, size))), -1)
            << "the second is cut at byte " << size << " of " << two.size();
}

TEST_F(Objects, DamageIsNotTakenForACut) {
    mrpt::io::CFileGZOutputStream out(folder.file("packed"));
    writeObjects(out, 4);
    out.close();
    std::string bytes = readText(folder.file("packed"));
    bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 0x55);
    EXPECT_EQ(countObjects(write("flipped", bytes)), -2);
    EXPECT_EQ(countObjects(write("garbage", "this is not what MRPT writes, not at all")), -2);
}

}  // namespace
