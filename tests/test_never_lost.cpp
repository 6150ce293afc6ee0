// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
//
// Maps are never lost once they are made, and what goes wrong is told: exports that fail, full
// disks, ^C, mistyped names, exit statuses.
#include <thread>

#include "background.h"
#include "build_fixture.h"

namespace {

using namespace build_tests;
using std::chrono::milliseconds;

class NeverLost : public Build {
 protected:
    std::string log() const { return plain("l.rawlog", walls()) + " --trajectory " + trajectory(); }
    std::string small() const { return write("p.pcd", asciiPcd("2 0 1\n", 1)); }
    static void expectHolds(const std::string& text, const std::string& part) {
        EXPECT_TRUE(holds(text, part)) << text << "lacks " << part;
    }
    std::set<std::string> files() const {
        std::set<std::string> names;
        for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
            names.insert(entry.path().filename());
        return names;
    }
};

// Outputs ---------------------------------------------------------------------------------

TEST_F(NeverLost, AFailingExportLeavesTheMap) {
    // Beyond what OctoMap's keys can hold: 32768 cells of 5 cm.
    const std::string far = write("far.pcd", asciiPcd("2000 0 1\n", 1));
    const auto run = build(far + " --max-range 3000 --export " + file("m.bt"));
    EXPECT_EQ(run.exit, 1);
    expectHolds(run.err, "cannot export to '" + file("m.bt") + "'");
    EXPECT_GT(AkiMap::loadFromFile(file("m.akimap"))->cellCount(), 0u);
    EXPECT_FALSE(std::filesystem::exists(file("m.bt")));
    expectHolds(json()["error"].get<std::string>(), "cannot export to");
}

TEST_F(NeverLost, AFullDiskIsToldByTheNameAskedForAndTheReason) {
    const std::string input = log();
    buildMap(input);
    const auto limited = [&](const std::string& arguments) {
        return runCommand("ulimit -f 1; '" + std::string(AKIMAP_PROGRAM) + "' " + arguments);
    };
    for (const char* extension : {"csv", "ply", "pcd", "ot", "3Dscene", "png"}) {
        const std::string out = file(std::string("o.") + extension);
        const auto before = files();
        const auto run = limited("export " + file("m.akimap") + " " + out);
        EXPECT_EQ(run.exit, 1);
        expectHolds(run.err, "cannot export to '" + out + "': File too large");
        EXPECT_EQ(files(), before) << "something is left behind";
    }
    for (const char* name : {"o.rawlog", "o.simplemap"}) {
        const auto run = limited("convert " + input + " -o " + file(name));
        EXPECT_EQ(run.exit, 1);
        expectHolds(run.err, "cannot write '" + file(name) + "': File too large");
    }
    const auto run =
        limited("build " + input + " -o " + file("o.akimap") + " --json " + file("o.json"));
    EXPECT_EQ(run.exit, 1);
    expectHolds(run.err, "cannot write '" + file("o.akimap") + "': File too large");
    expectHolds(readText(file("o.json")), "File too large");
}

TEST_F(NeverLost, AnErrorDoesNotReplaceAnInputByItsJson) {
    const std::string pcd = small();
    const auto run = runProgram("build " + pcd + " -o " + file("m.akimap") + " --json " + pcd);
    EXPECT_EQ(run.exit, 1);
    EXPECT_EQ(readText(pcd), asciiPcd("2 0 1\n", 1));
    write("older.akimap", "an older map");
    const auto twice = runProgram("build " + pcd + " -o " + file("older.akimap") + " --json " +
                                  file("older.akimap"));
    EXPECT_EQ(twice.exit, 1);
    EXPECT_EQ(readText(file("older.akimap")), "an older map");
}

TEST_F(NeverLost, HoldoutWithoutAnOutputIsRefused) {
    const auto run = runProgram("holdout --quiet " + log());
    EXPECT_EQ(run.exit, 1);
    expectHolds(run.err, "--quiet without an output");
    const auto failing = runProgram("holdout none.rawlog --json " + file("h.json"));
    EXPECT_EQ(failing.exit, 1);
    expectHolds(readText(file("h.json")), "none.rawlog: no such file");
}

TEST_F(NeverLost, OnATerminalItTellsWhatItIsAt) {
    if (runCommand("command -v script").exit != 0) GTEST_SKIP() << "needs the program script";
    const auto onTerminal = [&](const std::string& arguments) {
        return runCommand("script -qec \"'" + std::string(AKIMAP_PROGRAM) + "' " + arguments +
                          "\" /dev/null")
            .out;
    };
    const std::string shown =
        onTerminal("build " + small() + " -o " + file("m.akimap") + " --export " + file("m.bt"));
    expectHolds(shown, "writing " + file("m.akimap") + " ...");
    expectHolds(shown, "exporting " + file("m.bt") + " ...");
    expectHolds(onTerminal("export " + file("m.akimap") + " " + file("m.ply")), "exporting ");
    expectHolds(onTerminal("eval " + file("m.akimap") + " --truth " + file("m.bt")), "evaluating ");
    EXPECT_FALSE(holds(build(small() + " --export " + file("m.bt")).err, "exporting"));
}

// Signals ---------------------------------------------------------------------------------

class Interrupted : public NeverLost {
 protected:
    /** Many scans, each some milliseconds of work. */
    std::string longLog() const {
        Objects scans;
        std::string poses;
        for (int i = 0; i < 3000; i++) {
            scans.push_back(wall(i % kScans));
            std::dynamic_pointer_cast<CObservation>(scans.back())->timestamp =
                mrpt::Clock::fromDouble(kStart + 0.01 * i);
            char line[100];
            std::snprintf(line, sizeof line, "%.6f %.3f 0 0 0 0 0 1\n", kStart + 0.01 * i,
                          0.01 * i);
            poses += line;
        }
        return plain("long.rawlog", scans) + " --trajectory " + write("long.tum", poses);
    }
    std::string arguments(const std::string& more = "") const {
        return "build " + longLog() + " --resolution 0.02 --threads 1 -o " + file("m.akimap") +
               " --json " + file("m.json") + " " + more;
    }
    /** Waits until it has read the log through once and is at work on its scans. */
    void waitUntilItMaps(const Background& program) const {
        const auto size = static_cast<long>(std::filesystem::file_size(file("long.rawlog")));
        long furthest = 0;
        for (int i = 0; i < 2000; i++) {
            const long at = program.readingPosition(file("long.rawlog"));
            if (at >= 0 && at < furthest && at > size / 50) return;
            furthest = std::max(furthest, at);
            std::this_thread::sleep_for(milliseconds(5));
        }
        ADD_FAILURE() << "it never came to its scans";
    }
    /** The only files are these, besides the inputs. */
    void expectOnly(std::set<std::string> names) const {
        names.insert({"long.rawlog", "long.tum", "run.out", "run.err"});
        EXPECT_EQ(files(), names);
    }
};

TEST_F(Interrupted, TheMapOfTheScansSoFarIsWritten) {
    for (const bool by_terminal : {true, false}) {
        Background program(arguments(), file("run"));
        waitUntilItMaps(program);
        by_terminal ? program.interrupt() : program.terminate();
        const auto run = program.wait();
        EXPECT_EQ(run.exit, 3) << run.err;
        const auto counts = json();
        const auto scans = counts["scans"].get<int>();
        EXPECT_GT(scans, 0);
        EXPECT_LT(scans, 3000);
        EXPECT_EQ(counts["interrupted"], true);
        expectHolds(run.err, "interrupted: " + file("m.akimap") + " holds the first " +
                                 std::to_string(scans) + " scans");
        EXPECT_EQ(AkiMap::loadFromFile(file("m.akimap"))->cellCount(), counts["cells"]);
        expectOnly({"m.akimap", "m.json"});
        std::filesystem::remove(file("m.akimap"));
    }
}

TEST_F(Interrupted, OrNoneIfSoAsked) {
    Background program(arguments("--on-interrupt discard"), file("run"));
    waitUntilItMaps(program);
    program.interrupt();
    EXPECT_EQ(program.wait().exit, 128 + SIGINT);
    expectOnly({});
}

TEST_F(Interrupted, ASecondSignalStopsAtOnceAndLeavesNothing) {
    // One scan so large that its insertion takes seconds.
    std::string points;
    for (int i = 0; i < 1200000; i++)
        points += "7 " + std::to_string(0.005 * (i % 1200) - 3) + " " +
                  std::to_string(0.005 * (i / 1200) - 2) + "\n";
    write("long.tum", "");
    write("long.rawlog", "");
    const std::string big = write("big.pcd", asciiPcd(points, 1200000));
    Background program("build " + big + " --resolution 0.01 --threads 1 -o " + file("m.akimap"),
                       file("run"));
    std::this_thread::sleep_for(milliseconds(3000));
    program.interrupt();
    std::this_thread::sleep_for(milliseconds(100));
    const auto start = std::chrono::steady_clock::now();
    program.interrupt();
    EXPECT_EQ(program.wait().exit, 128 + SIGINT);
    EXPECT_LT(std::chrono::steady_clock::now() - start, milliseconds(1500));
    expectOnly({"big.pcd"});
}

// Words -----------------------------------------------------------------------------------

TEST_F(NeverLost, MistypedNamesAreRecognized) {
    const auto told = [&](const std::string& arguments, int status, const std::string& part) {
        const auto run = runProgram(arguments);
        EXPECT_EQ(run.exit, status) << arguments;
        expectHolds(run.err, part);
        EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    };
    told("buil x.pcd", 2, "no command 'buil'; did you mean build?");
    told("xyzzy", 2, "no command 'xyzzy'; akimap --help");
    told("build x.pcd -o m.akimap --resolutoin 1", 2,
         "no option --resolutoin; did you mean --resolution?");
    const std::string ini = "[MappingApplication]\nakimap_count = 1\n";
    const std::string build = "build " + small() + " -o " + file("m.akimap") + " -c ";
    told(build + write("a.ini", ini + "[MappingApplicaton_akimap_00_insertOpts]\nmax_range = 3\n"),
         1, "did you mean [MappingApplication_akimap_00_insertOpts]?");
    told(
        build + write("b.ini", ini + "[MappingApplication_akimap_00_creationOpts]\nresolutoin=1\n"),
        1, "unknown key resolutoin; did you mean resolution?");
}

TEST_F(NeverLost, TheLibraryTellsOfMistypedNamesToo) {
    mrpt::config::CConfigFileMemory ini(
        std::string("[map_akimap_00_creationOpts]\nresolutoin = 1\n[map_akimap_00_insrtOpts]\n"
                    "max_range = 3\n[map_akimap_01_insertOpts]\nmax_range = 4\n"));
    testing::internal::CaptureStderr();
    AkiMap::TMapDefinition definition;
    definition.loadFromConfigFile(ini, "map_akimap_00");
    const std::string err = testing::internal::GetCapturedStderr();
    expectHolds(err, "unknown key resolutoin; did you mean resolution?");
    expectHolds(
        err, "unknown section [map_akimap_00_insrtOpts]; did you mean [map_akimap_00_insertOpts]?");
    EXPECT_FALSE(holds(err, "_01_")) << "that is another map's: " << err;
}

TEST_F(NeverLost, ExitStatusesAreAsTheHelpSays) {
    EXPECT_EQ(build(small()).exit, 0);
    EXPECT_EQ(build("none.pcd").exit, 1);
    EXPECT_EQ(runProgram("build --no-such-option").exit, 2);
    expectHolds(runProgram("--help").out, "Exit status: 0 done; 1 failed");
}

// Poor maps -------------------------------------------------------------------------------

TEST_F(NeverLost, ReturnsLostToTheDefaultRangeAreToldBeforeTheTable) {
    const std::string far = write("f.pcd", asciiPcd("2 0 1\n20 0 1\n21 0 1\n", 3));
    const auto run = build(far);
    EXPECT_EQ(run.exit, 0);
    expectHolds(run.err, "warning: 67 % of the returns are out of range");
    expectHolds(run.err, "--max-range");
    EXPECT_EQ(build(far + " --max-range 10").err, "") << "who says the range wants it";
}

TEST_F(NeverLost, OnePoseForAllScansIsTold) {
    Objects still = walls();
    for (int i = 0; i < kScans; i++) still.push_back(robotPose(i, CPose3D()));
    expectHolds(build(plain("still.rawlog", still)).err, "one and the same pose");
    EXPECT_EQ(build(log()).err, "");
    EXPECT_EQ(build(plain("one.rawlog", {wall(0)})).err, "") << "one scan needs no pose";
}

}  // namespace
