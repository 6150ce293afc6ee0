// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers

// The stock MRPT programs that have no window, as installed, with this library and the shipped
// INIs, as share/akimap/README.md tells users to call them.
#include <gtest/gtest.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CRawlog.h>

#include <sstream>

#include "build_fixture.h"
#include "mrpt/mrpt_compat.h"
#include "same_map.h"

namespace {

using akimap::AkiMap;
using build_tests::holds;

const std::string kDatasets = "/usr/share/mrpt/datasets/";
const std::string kLoop = kDatasets + "2006-01ENE-21-SENA_Telecom Faculty_one_loop_only.rawlog";

class Programs : public ::testing::Test {
 protected:
    void SetUp() override {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
        GTEST_SKIP() << "a sanitized library can't be loaded into programs that are not";
#endif
    }
    std::string file(const std::string& name) const {
        return folder.file(name);
    }
    static std::string shipped(const std::string& ini) {
        return std::string(AKIMAP_SOURCE_DIR) + "/share/akimap/config_files/" + ini;
    }
    /** Copies a shipped INI with one line, given without its end, replaced. */
    std::string changed(const std::string& ini, const std::string& from,
                        const std::string& to) const {
        std::string text = readText(shipped(ini));
        const auto at = text.find("\n" + from);
        EXPECT_NE(at, std::string::npos) << ini << " has no line " << from;
        if (at != std::string::npos) text.replace(at + 1, text.find('\n', at + 1) - at - 1, to);
        writeText(file(ini), text);
        return file(ini);
    }
    /** Runs it in the test's folder and expects success, without a word of a missing class. */
    void run(const std::string& command) const {
        const ::Run done = runCommand("cd '" + folder.path().string() + "' && " + command);
        EXPECT_EQ(done.exit, 0) << command << "\n" << done.err;
        for (const char* bad : {"not registered", "xception", "unknown class"}) {
            EXPECT_FALSE(holds(done.out, bad)) << command << "\n" << done.out;
            EXPECT_FALSE(holds(done.err, bad)) << command << "\n" << done.err;
        }
    }
    void runPreloaded(const std::string& command) const {
        run(std::string("LD_PRELOAD='") + AKIMAP_LIBRARY + "' " + command);
    }
    AkiMap::Ptr map(const std::string& name) const {
        return AkiMap::loadFromFile(file(name));
    }

    void expectScene(const std::string& name) const {
        ASSERT_TRUE(std::filesystem::exists(file(name))) << name;
        akimap::SceneObject scene;
        EXPECT_TRUE(scene.loadFromFile(file(name))) << name;
    }
    /** Expects the cells that akimap build makes of the same scans by the same INI. */
    void expectAsBuilt(const AkiMap& map, const std::string& scans, const std::string& ini,
                       const std::string& section) const {
        const ::Run build = runProgram("build --quiet '" + scans + "' -c '" + ini + "' --section " +
                                       section + " -o " + file("built.akimap"));
        ASSERT_EQ(build.exit, 0) << build.err;
        const auto built = AkiMap::loadFromFile(file("built.akimap"));
        EXPECT_GT(map.occupiedCells().size(), 1000u);
        EXPECT_EQ(akimap::test::cellsFingerprint(map), akimap::test::cellsFingerprint(*built));
    }
    std::string drive() const {
        const ::Run run = runProgram("simulate structured -o " + file("drive"));
        EXPECT_EQ(run.exit, 0) << run.err;
        return file("drive") + "/";
    }

    TemporaryFolder folder;
};

/** The drive as a robot logs it: odometry between the scans. */
void addOdometry(const std::string& drive, const std::string& output) {
    std::vector<mrpt::obs::CObservation::Ptr> all;
    std::istringstream poses(readText(drive + "trajectory.tum"));
    for (std::string line; std::getline(poses, line);) {
        double t, x, y, z, qx, qy, qz, qw;
        if (!(std::istringstream(line) >> t >> x >> y >> z >> qx >> qy >> qz >> qw)) continue;
        auto odometry = mrpt::obs::CObservationOdometry::Create();
        odometry->timestamp = mrpt::Clock::fromDouble(t);
        odometry->odometry = mrpt::poses::CPose2D(x, y, 2 * std::atan2(qz, qw));
        all.push_back(odometry);
    }
    mrpt::obs::CRawlog scans;
    ASSERT_TRUE(scans.loadFromRawLogFile(drive + "scene.rawlog"));
    for (std::size_t i = 0; i < scans.size(); i++) all.push_back(scans.getAsObservation(i));
    std::stable_sort(all.begin(), all.end(),
                     [](const auto& a, const auto& b) { return a->timestamp < b->timestamp; });
    build_tests::writeGz(output, {all.begin(), all.end()});
}

/** Share of the points of a points map's text file that have an occupied cell within `reach`
 * cells: the returns of the scans that were inserted into both maps. */
double shareOccupied(const AkiMap& map, const std::string& points_file, int reach) {
    std::istringstream points(readText(points_file));
    const double cell = map.resolution();
    int count = 0, hits = 0;
    for (std::string line; std::getline(points, line); count++) {
        double x = 0, y = 0, z = 0;
        std::istringstream(line) >> x >> y >> z;
        bool hit = false;
        for (int i = -reach; i <= reach; i++)
            for (int j = -reach; j <= reach; j++)
                hit = hit || map.occupancy(x + i * cell, y + j * cell, z).value_or(0) > 0.5;
        hits += hit;
    }
    return count > 0 ? static_cast<double>(hits) / count : 0;
}

TEST_F(Programs, IcpSlamBuildsTheMapOfItsOwnPath) {
    const std::string ini = shipped("icp-slam.ini");
    runPreloaded("icp-slam '" + ini + "' '" + kLoop + "'");
    const std::string out = "LOG_ICP-SLAM/";
    expectScene(out + "_finalmaps_.txt_akimap__AkiMap_00_3D.3Dscene");
    expectAsBuilt(*map(out + "_finalmaps_.txt_akimap__AkiMap_00.akimap"),
                  file(out + "_finalmap_.simplemap"), ini, "MappingApplication");
}

TEST_F(Programs, IcpSlamMapsA3DDrive) {
    addOdometry(drive(), file("odometry.rawlog"));
    const std::string ini = changed("icp-slam.ini", "# alwaysInsertByClass",
                                    "alwaysInsertByClass = CObservation3DRangeScan");
    runPreloaded("icp-slam " + ini + " odometry.rawlog");
    const auto m = map("LOG_ICP-SLAM/_finalmaps_.txt_akimap__AkiMap_00.akimap");
    expectAsBuilt(*m, file("LOG_ICP-SLAM/_finalmap_.simplemap"), ini, "MappingApplication");
    const auto box = m->boundingBox();
    // Kernels of 10 cm cells reach beyond the walls' ends.
    EXPECT_NEAR(box.max.z - box.min.z, 2.1 + 0.8, 0.5) << "the room is 2.1 m high";
}

TEST_F(Programs, EachParticleOfRbpfSlamHasAMapOfItsScans) {
    run(std::string("rawlog-edit -q -p '") + AKIMAP_LIBRARY + "' --cut --to-index 79 -i '" + kLoop +
        "' -o short.rawlog");
    runPreloaded("rbpf-slam '" + shipped("rbpf-slam.ini") + "' short.rawlog");
    const std::string out = "LOG_RBPF-SLAM/finalMap_";
    expectScene(out + "akimap__AkiMap_00_3D.3Dscene");
    const auto m = map(out + "akimap__AkiMap_00.akimap");
    EXPECT_EQ(m->resolution(), 0.1);
    EXPECT_EQ(m->insertionOptions.max_range, 15);
    EXPECT_GT(shareOccupied(*m, file(out + "mrpt__maps__CSimplePointsMap_01.txt"), 1), 0.5);
}

TEST_F(Programs, PfLocalizationFillsTheMapFromASimplemap) {
    const std::string ini = shipped("pf-localization.ini");
    runPreloaded("pf-localization '" + ini + "'");
    const std::string map_prefix = "LOG_LOCALIZATION_000_0040000/map_akimap__AkiMap_00";
    expectScene(map_prefix + "_3D.3Dscene");
    expectAsBuilt(*map(map_prefix + ".akimap"), kDatasets + "localization_demo.simplemap.gz", ini,
                  "MetricMap");
}

TEST_F(Programs, Observations2mapMakesTheMapThatAkimapBuildMakes) {
    const std::string scans = drive() + "scene.simplemap", ini = shipped("observations2map.ini");
    runPreloaded("observations2map '" + ini + "' '" + scans + "' out");
    expectScene("out_akimap__AkiMap_00_3D.3Dscene");
    const auto m = map("out_akimap__AkiMap_00.akimap");
    expectAsBuilt(*m, scans, ini, "MappingApplication");
    // The INI only repeats defaults, so that without it nothing changes.
    ASSERT_EQ(runProgram("build --quiet '" + scans + "' -o " + file("plain.akimap")).exit, 0);
    EXPECT_EQ(readText(file("plain.akimap")), readText(file("out_akimap__AkiMap_00.akimap")));
}

TEST_F(Programs, RawlogEditWritesTheSameLogWithAndWithoutIt) {
    const std::string cut = " --cut --from-index 10 --to-index 29 -i '" + kLoop + "' -o ";
    run(std::string("rawlog-edit -q -p '") + AKIMAP_LIBRARY + "'" + cut + "with.rawlog");
    run("rawlog-edit -q" + cut + "without.rawlog");
    EXPECT_GT(readText(file("with.rawlog")).size(), 1000u);
    EXPECT_EQ(readText(file("with.rawlog")), readText(file("without.rawlog")));
}

// rawlog-grabber replays a log through its camera driver, ends at the log's end (which it reports
// as an exception) and always loses the last of a sensor's observations.
TEST_F(Programs, RawlogGrabberRecordsWithIt) {
    writeText(file("grab.ini"),
              "[global]\nrawlog_prefix = grabbed\nuse_sensoryframes = 0\n"
              "time_between_launches = 10\nGRABBER_PERIOD_MS = 100\n"
              "[DEPTH]\ndriver = CCameraSensor\nprocess_rate = 20\nsensorLabel = DEPTH\n"
              "grabber_type = rawlog\nrawlog_camera_sensor_label = DEPTH\nrawlog_file = " +
                  drive() + "scene.rawlog\n");
    // A key pressed ends it, and so would the end of its input.
    const ::Run grab =
        runCommand("cd '" + folder.path().string() + "' && sleep 3 | rawlog-grabber -p '" +
                   AKIMAP_LIBRARY + "' grab.ini && mv grabbed_*.rawlog grabbed.rawlog");
    ASSERT_EQ(grab.exit, 0) << grab.err;
    EXPECT_FALSE(holds(grab.out + grab.err, "not registered"));
    const ::Run build = runProgram("build --quiet " + file("grabbed.rawlog") + " --trajectory " +
                                   file("drive/trajectory.tum") + " -o " + file("m.akimap") +
                                   " --json " + file("m.json"));
    ASSERT_EQ(build.exit, 0) << build.err;
    EXPECT_GE(map("m.akimap")->occupiedCells().size(), 1000u);
}

}  // namespace
