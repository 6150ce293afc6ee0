// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
//
// `akimap build --realtime`: which scans a robot would lose while it maps.

#include "build_fixture.h"
#include "mapping/RealtimeGate.h"
#include "mapping/build_report.h"
#include "quantile.h"

namespace {

using namespace build_tests;
using akimap::app::quantile;
using akimap::app::RealtimeGate;

/** The numbers of the scans that are used if each update takes `update_seconds`. */
std::vector<int> usedOf(const std::vector<double>& stamps, double update_seconds,
                        RealtimeGate& gate) {
    std::vector<int> used;
    for (std::size_t i = 0; i < stamps.size(); i++)
        if (gate.offer(stamps[i])) {
            used.push_back(static_cast<int>(i));
            gate.used(update_seconds);
        }
    return used;
}

TEST(RealtimeGate, ScansThatComeDuringAnUpdateAreLost) {
    std::vector<double> stamps;  // 8 Hz: exact in binary
    for (int i = 0; i < 10; i++) stamps.push_back(kStart + i / 8.0);
    RealtimeGate slow, exact, quick;
    EXPECT_EQ(usedOf(stamps, 0.3, slow), (std::vector<int>{0, 3, 6, 9}));
    EXPECT_EQ(slow.offered(), 10u);
    EXPECT_EQ(slow.used(), 4u);
    EXPECT_EQ(slow.lost(), 6u);
    EXPECT_EQ(slow.lostOutOfOrder(), 0u);
    EXPECT_EQ(usedOf(stamps, 0.25, exact), (std::vector<int>{0, 2, 4, 6, 8}))
        << "a scan that comes as the update ends is used";
    EXPECT_EQ(usedOf(stamps, 0.1, quick).size(), 10u);
    EXPECT_EQ(quick.lost(), 0u);
}

TEST(RealtimeGate, OnlyTheLastUpdateCountsAndLostScansTakeNoTime) {
    RealtimeGate gate;
    ASSERT_TRUE(gate.offer(0));
    gate.used(5);
    EXPECT_FALSE(gate.offer(4.9));
    ASSERT_TRUE(gate.offer(5));
    gate.used(0.5);
    EXPECT_TRUE(gate.offer(5.5));
}

TEST(RealtimeGate, ScansOutOfOrderAreLostAndCountedApart) {
    RealtimeGate gate;
    // 1 and 8 come before the last used scan, 4.5 only during its update.
    EXPECT_EQ(usedOf({2, 4, 1, 4.5, 9, 8, 10}, 1, gate), (std::vector<int>{0, 1, 4, 6}));
    EXPECT_EQ(gate.lost(), 3u);
    EXPECT_EQ(gate.lostOutOfOrder(), 2u);
}

TEST(Quantile, NearestRank) {
    std::vector<double> values;
    for (int i = 200; i > 0; i--) values.push_back(i);
    EXPECT_EQ(quantile(values, 0.5), 100);
    EXPECT_EQ(quantile(values, 0.99), 198);
    EXPECT_EQ(quantile(std::vector<double>{3, 1, 2}, 0.5), 2);
    EXPECT_EQ(quantile(std::vector<double>{3, 1, 2}, 0.99), 3);
    EXPECT_EQ(quantile(std::vector<double>{7}, 0.5), 7);
}

/** The walls, with the given seconds between their stamps, seen from their right poses. */
Objects wallsApart(double seconds) {
    Objects log;
    for (int i = 0; i < kScans; i++) {
        const auto time = mrpt::Clock::fromDouble(kStart + seconds * i);
        auto scan = wall(i);
        scan->timestamp = time;
        auto pose = robotPose(i, poseOf(i));
        pose->timestamp = time;
        log.insert(log.end(), {pose, scan});
    }
    return log;
}

TEST_F(Build, RealtimeByTheLogsStamps) {
    // No update takes 1000 s, and none less than a microsecond.
    EXPECT_EQ(buildMap(plain("slow.rawlog", wallsApart(1000)) + " --realtime"), expectedMap());
    EXPECT_EQ(json()["scans_lost"], 0);
    const auto run = build(plain("quick.rawlog", wallsApart(1e-6)) + " --realtime");
    EXPECT_EQ(run.exit, 0) << run.err;
    EXPECT_EQ(fingerprint(file("m.akimap")), expectedMap(1));
    EXPECT_EQ(json()["scans_offered"], kScans);
    EXPECT_EQ(json()["scans_used"], 1);
    EXPECT_EQ(json()["scans_lost"], kScans - 1);
    EXPECT_EQ(json()["scans_lost_out_of_order"], 0);
    EXPECT_EQ(json()["update_seconds_median"], json()["insertion_seconds"]);
    EXPECT_EQ(json()["update_seconds_p99"], json()["insertion_seconds"]);
    for (const char* name : {"scans offered", "lost", "median", "99th"})
        EXPECT_TRUE(holds(run.out, name)) << run.out << "lacks " << name;
}

TEST_F(Build, RateCountsOverAllInputsAndGoesBeforeStamps) {
    const std::string a = write("a.pcd", asciiPcd("2 0 1\n", 1)) + " ";
    const std::string b = write("b.pcd", asciiPcd("0 2 1\n", 1)) + " ";
    const std::string all = buildMap(a + b + a), first = buildMap(a);
    EXPECT_FALSE(json().contains("scans_offered")) << "not in real time";
    EXPECT_EQ(buildMap(a + b + a + "--realtime --rate 1e-3"), all);
    EXPECT_EQ(buildMap(a + b + a + "--realtime --rate 1e9"), first);
    EXPECT_EQ(json()["scans_lost"], 2);
    EXPECT_EQ(buildMap(a + b + "--first 1 --realtime --rate 1e9"), first);
    EXPECT_EQ(json()["scans_offered"], 1);
    const std::string quick = plain("quick.rawlog", wallsApart(1e-6));
    EXPECT_EQ(buildMap(quick + " --realtime --rate 1e-3"), expectedMap());
}

TEST_F(Build, RealtimeNeedsStampsOrARate) {
    const std::string pcd = write("p.pcd", asciiPcd("2 0 1\n", 1));
    expectRefused(pcd + " --realtime", {pcd + ": a scan without a time stamp", "--rate"});
    auto log = wallsApart(1);
    std::dynamic_pointer_cast<CObservationPointCloud>(log.back())->timestamp = INVALID_TIMESTAMP;
    expectRefused(plain("l.rawlog", {wall(0), log.back()}) + " --realtime",
                  {file("l.rawlog") + ": a scan without a time stamp"});
    expectRefused(pcd + " --rate 10", {"--rate requires --realtime"});
    for (const char* wrong : {"0", "-1", "nan", "inf", "x"})
        expectRefused(pcd + " --realtime --rate " + wrong, {"--rate"});
    expectRefused(plain("f.rawlog", walls()) + " --follow --realtime", {"--follow", "--realtime"});
}

}  // namespace
