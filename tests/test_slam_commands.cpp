// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
//
// `akimap slam` and `akimap localize` with the settings and logs that come with MRPT.
#include <akimap/AkiMap.h>
#include <gtest/gtest.h>
#include <mrpt/system/filesystem.h>

#include <chrono>
#include <set>
#include <thread>

#include "background.h"
#include "run_program.h"

namespace {

bool holds(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

class SlamCommands : public ::testing::Test {
 protected:
    void SetUp() override {
        if (!std::filesystem::exists(log)) GTEST_SKIP() << "no " << log << " (package mrpt-common)";
    }

    std::string file(const std::string& name) const { return folder.file(name); }

    /** An INI of MRPT's with keys set, wherever in it they stand, and lines added behind it. */
    std::string ini(const std::string& name,
                    const std::vector<std::pair<std::string, std::string>>& keys,
                    const std::string& more = "") const {
        std::string text = readText(share + "config_files/" + name);
        for (const auto& [key, value] : keys) {
            const auto at = text.find("\n" + key);
            if (at == std::string::npos) throw std::runtime_error(name + " has no " + key);
            text.replace(at + 1, text.find('\n', at + 1) - at - 1, value);
        }
        writeText(file("c.ini"), text + "\n" + more);
        return file("c.ini");
    }
    std::string icpIni(const std::string& counts) const {
        return ini("icp-slam/icp-slam_demo_classic.ini",
                   {{"pointsMap_count", "pointsMap_count = 1\n" + counts},
                    {"SAVE_3D_SCENE", "SAVE_3D_SCENE = 0"}},
                   "[MappingApplication_akimap_00_creationOpts]\nresolution = 0.2\n");
    }
    std::string rbpfIni() const {
        return ini("rbpf-slam/gridmapping_optimal_sampling.ini",
                   {{"occupancyGrid_count", "occupancyGrid_count = 1\nakimap_count = 1"},
                    {"SAVE_3D_SCENE", "SAVE_3D_SCENE = 0"},
                    {"SAVE_MAP_IMAGES", "SAVE_MAP_IMAGES = 0"},
                    {"sampleSize", "sampleSize = 2"},
                    {"pfAuxFilterOptimal", "pfAuxFilterOptimal_MaximumSearchSamples = 10"}},
                   "[MappingApplication_akimap_00_creationOpts]\nresolution = 0.2\n");
    }
    std::string localizeIni(const std::string& init_mode) const {
        return ini("pf-localization/localization_demo.ini",
                   {{"occupancyGrid_count", "occupancyGrid_count = 0\nakimap_count = 1"},
                    {"init_PDF_mode", "init_PDF_mode = " + init_mode},
                    {"particles_count", "particles_count = 200"},
                    {"map_file", "map_file = " + share + "datasets/localization_demo.simplemap.gz"},
                    {"KLD_maxSampleSize", "KLD_maxSampleSize = 300"},
                    {"3DSceneFrequency", "3DSceneFrequency = -1"}},
                   "[MetricMap_akimap_00_creationOpts]\nresolution = 0.2\n");
    }
    /** Runs the command into the folder "out", and expects its table and its files. */
    ::Run expectResults(const std::string& command) const {
        const auto run = runProgram(command + " -o " + file("out"));
        EXPECT_EQ(run.exit, 0) << run.err;
        EXPECT_EQ(run.err, "");
        EXPECT_EQ(run.out.rfind("poses ", 0), 0u) << "something stands before the table:\n"
                                                  << run.out;
        const auto map = akimap::AkiMap::loadFromFile(file("out/map.akimap"));
        EXPECT_GT(map->cellCount(), 1000u);
        EXPECT_EQ(map->resolution(), 0.2);
        EXPECT_TRUE(holds(run.out, " " + std::to_string(map->cellCount()) + " ")) << run.out;
        std::ifstream trajectory(file("out/trajectory.tum"));
        std::size_t poses = 0;
        for (std::string line; std::getline(trajectory, line);) poses += line[0] != '#';
        EXPECT_GT(poses, 30u);
        EXPECT_TRUE(holds(run.out, " " + std::to_string(poses) + " ")) << run.out;
        return run;
    }
    void expectRefused(const std::string& command, const std::vector<std::string>& parts) const {
        const auto run = runProgram(command + " -o " + file("none"));
        EXPECT_EQ(run.exit, 1) << command << run.err;
        EXPECT_EQ(run.out, "");
        EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
        for (const std::string& part : parts) EXPECT_TRUE(holds(run.err, part)) << run.err;
        EXPECT_FALSE(std::filesystem::exists(file("none"))) << "left a folder behind";
    }

    const std::string share = mrpt::system::getShareMRPTDir();
    const std::string log =
        share + "datasets/2006-01ENE-21-SENA_Telecom Faculty_one_loop_only.rawlog";
    const std::string quoted_log = "'" + log + "'";
    TemporaryFolder folder;
};

TEST_F(SlamCommands, IcpSlamLeavesAMapAndWhatElseIsInTheFolder) {
    std::filesystem::create_directory(file("out"));
    writeText(file("out/mine.txt"), "precious");
    expectResults("slam " + icpIni("akimap_count = 1") + " " + quoted_log);
    EXPECT_EQ(readText(file("out/mine.txt")), "precious");
    EXPECT_TRUE(std::filesystem::exists(file("out/_finalmap_.simplemap")));
    // The poses fit the log: the log is built into a map along them.
    const auto built = runProgram("build " + quoted_log + " --first 3 --trajectory " +
                                  file("out/trajectory.tum") + " -o " + file("b.akimap"));
    EXPECT_EQ(built.exit, 0) << built.err;
}

TEST_F(SlamCommands, RbpfSlamIsRecognizedByItsIni) {
    expectResults("slam " + rbpfIni() + " " + quoted_log);
    EXPECT_TRUE(std::filesystem::exists(file("out/most_likely_path.txt")));
}

TEST_F(SlamCommands, LocalizationInAnAkiMapAlone) {
    expectResults("localize " + localizeIni("1") + " " + share +
                  "datasets/localization_demo.rawlog");
}

TEST_F(SlamCommands, AnUnknownMapIsAnErrorWhateverItsCase) {
    for (const char* key : {"AKIMAP_COUNT", "AKIMAP_count"}) {
        const std::string known = icpIni(std::string(key) + " = 1\nfancyMap_count = 0");
        expectResults("slam " + known + " " + quoted_log);
    }
    expectRefused("slam " + icpIni("akimaps_count = 1") + " " + quoted_log,
                  {"c.ini: [MappingApplication] akimaps_count = 1", "akimap, "});
    expectRefused("slam " + icpIni("akimap_count = 1") + " " + file("no.rawlog"),
                  {"no.rawlog: no such file"});
}

TEST_F(SlamCommands, ErrorsAreOneLine) {
    expectRefused("slam " + file("no.ini") + " " + quoted_log, {"no.ini: no such file"});
    expectRefused("localize " + icpIni("akimap_count = 1") + " " + quoted_log,
                  {"c.ini: no section [LocalizationExperiment]"});
    expectRefused("slam " + localizeIni("1") + " " + quoted_log,
                  {"c.ini: no section [MappingApplication]"});
    expectRefused("localize " + localizeIni("0") + " " + quoted_log, {"init_PDF_mode = 0"});
    // MRPT's application itself refuses this one, before the log is begun.
    const std::string no_icp = ini("icp-slam/icp-slam_demo_classic.ini",
                                   {{"ICP_algorithm", "ICP_algorithm = icpNone"},
                                    {"pointsMap_count", "pointsMap_count = 1\nakimap_count = 1"}});
    expectRefused("slam " + no_icp + " " + quoted_log, {"c.ini: ", "icpNone"});
    writeText(file("bad.rawlog"), "this is not what MRPT writes");
    expectRefused("slam " + icpIni("akimap_count = 1") + " " + file("bad.rawlog"),
                  {"bad.rawlog: object 1"});
}

std::set<std::string> filesIn(const std::string& folder) {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        names.insert(entry.path().filename().string());
    return names;
}

/** Whether a file whose name ends so is, or within a minute comes to be, below the folder. */
bool appears(const std::string& folder, const std::string& ending) {
    namespace fs = std::filesystem;
    for (int i = 0; i < 6000; i++) {
        std::error_code error;  // folders come and go meanwhile
        for (fs::recursive_directory_iterator e(folder, error), end; !error && e != end;
             e.increment(error)) {
            const std::string name = e->path().filename().string();
            const auto at = name.rfind(ending);
            if (at != std::string::npos && at + ending.size() == name.size()) return true;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
}

TEST_F(SlamCommands, AnInterruptEndsTheLogThereAndTheResultsAreWritten) {
    const std::string shipped = std::string(AKIMAP_SOURCE_DIR) + "/share/akimap/config_files/";
    struct Case {
        std::string arguments, started;
        std::chrono::milliseconds then;
        std::ptrdiff_t poses;  ///< of the whole log
    };
    for (const Case& c : {Case{"slam " + shipped + "rbpf-slam.ini " + quoted_log,
                               "log_estimated_path.txt", std::chrono::milliseconds(500), 224},
                          Case{"localize " + shipped + "pf-localization.ini " + share +
                                   "datasets/localization_demo.rawlog",
                               ".akimap", std::chrono::milliseconds(0), 37}}) {
        const std::string out = file("out");
        std::filesystem::remove_all(out);
        Background program(c.arguments + " -o " + out, file("said"));
        ASSERT_TRUE(appears(out, c.started));
        std::this_thread::sleep_for(c.then);
        program.interrupt();
        const ::Run run = program.wait();
        EXPECT_EQ(run.exit, 0) << run.err;
        const auto map = akimap::AkiMap::loadFromFile(out + "/map.akimap");
        EXPECT_TRUE(holds(run.out, " " + std::to_string(map->cellCount()) + " ")) << run.out;
        const std::string trajectory = readText(out + "/trajectory.tum");
        const auto poses = std::count(trajectory.begin(), trajectory.end(), '\n') - 1;
        EXPECT_LT(poses, c.poses) << c.arguments;
    }
}

TEST_F(SlamCommands, WhatThreadsOfMrptsThrowLeavesNothingBehind) {
    // A particle filter that pf-localization lacks: it finds out in a thread.
    const std::string lacking =
        ini("pf-localization/localization_demo.ini",
            {{"PF_algorithm", "PF_algorithm = 2"},
             {"occupancyGrid_count", "occupancyGrid_count = 0\nakimap_count = 1"},
             {"init_PDF_mode", "init_PDF_mode = 1"},
             {"map_file", "map_file = " + share + "datasets/localization_demo.simplemap.gz"},
             {"3DSceneFrequency", "3DSceneFrequency = -1"}});
    const std::string arguments =
        "localize " + lacking + " " + share + "datasets/localization_demo.rawlog";
    expectRefused(arguments, {"pfOptimalProposal"});
    std::filesystem::create_directory(file("out"));
    writeText(file("out/mine.txt"), "precious");
    EXPECT_EQ(runProgram(arguments + " -o " + file("out")).exit, 1);
    EXPECT_EQ(filesIn(file("out")), std::set<std::string>{"mine.txt"});
}

TEST_F(SlamCommands, ASecondSignalEndsItAtOnceAndLeavesNothingBehind) {
    const std::string shipped = std::string(AKIMAP_SOURCE_DIR) + "/share/akimap/config_files/";
    std::filesystem::create_directory(file("out"));
    writeText(file("out/mine.txt"), "precious");
    Background program("slam " + shipped + "rbpf-slam.ini " + quoted_log + " -o " + file("out"),
                       file("said"));
    ASSERT_TRUE(appears(file("out"), "log_estimated_path.txt"));
    program.interrupt();
    program.terminate();  // two of a kind are one signal while none is handled
    const int exit = program.wait().exit;
    EXPECT_TRUE(exit == 128 + SIGINT || exit == 128 + SIGTERM) << exit;
    EXPECT_EQ(filesIn(file("out")), std::set<std::string>{"mine.txt"});
}

TEST_F(SlamCommands, AClosedTerminalEndsTheLogLikeAnInterrupt) {
    const std::string shipped = std::string(AKIMAP_SOURCE_DIR) + "/share/akimap/config_files/";
    Background program("slam " + shipped + "rbpf-slam.ini " + quoted_log + " -o " + file("out"),
                       file("said"));
    ASSERT_TRUE(appears(file("out"), "log_estimated_path.txt"));
    program.hangUp();
    EXPECT_EQ(program.wait().exit, 0);
    const auto files = filesIn(file("out"));
    EXPECT_EQ(files.count("map.akimap"), 1u);
    for (const std::string& name : files) EXPECT_NE(name[0], '.') << name;
}

TEST_F(SlamCommands, HelpTellsHowTheMethodIsChosen) {
    const auto help = runProgram("slam --help");
    EXPECT_EQ(help.exit, 0);
    EXPECT_TRUE(holds(help.out, "PF_algorithm")) << help.out;
    EXPECT_EQ(runProgram("localize --help").exit, 0);
}

}  // namespace
