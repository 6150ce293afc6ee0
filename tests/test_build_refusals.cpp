// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
//
// What `akimap build` refuses: bad files, bad settings, outputs that can't be written.

#include "build_fixture.h"

namespace {

using namespace build_tests;

TEST_F(Build, ACutRawlogIsRefusedUnlessPartial) {
    const std::string poses = " --trajectory " + trajectory();
    writeGz(file("packed.rawlog"), walls());
    for (const std::string& log : {plain("plain.rawlog", walls()), file("packed.rawlog")}) {
        const std::string whole = readText(log);
        writeText(log, whole.substr(0, whole.size() - 30));
        expectRefused(log + poses, {log + ": ", "--partial"});
        const auto run = build(log + poses + " --partial");
        EXPECT_EQ(run.exit, 0) << run.err;
        EXPECT_TRUE(holds(run.err, "warning: " + log)) << run.err;
        EXPECT_EQ(fingerprint(file("m.akimap")), expectedMap(kScans - 1));
        writeText(log, whole.substr(0, 20));
        expectRefused(log + poses, {log + ": "});
        expectRefused(log + " --partial", {"nothing usable"});
    }
}

TEST_F(Build, FilesThatAreNoneOrNotWhatTheirNameSaysAreRefused) {
    expectRefused(file("none.rawlog"), {file("none.rawlog") + ": no such file"});
    expectRefused(file("none.pcd"), {file("none.pcd") + ": no such file"});
    expectRefused(write("g.rawlog", "this is not what MRPT writes"), {file("g.rawlog") + ": "});
    expectRefused(write("e.rawlog", ""), {file("e.rawlog") + ": not a rawlog"});
    expectRefused(write("g.simplemap", "nor is this"), {file("g.simplemap") + ": "});
    expectRefused(write("g.pcd", "nor is this"), {file("g.pcd") + ": line 1"});
    expectRefused(write("g.las", "?"), {file("g.las") + ": not a .rawlog", "pdal translate"});
    std::filesystem::create_directory(file("folder.rawlog"));
    expectRefused(file("folder.rawlog"), {file("folder.rawlog") + ": this is a folder"});
    // A good input before a bad one does not help.
    const std::string good = write("p.pcd", asciiPcd("2 0 1\n", 1));
    expectRefused(good + " " + write("s.pcd", asciiPcd("2 0 1\n", 2)), {file("s.pcd") + ": "});
}

TEST_F(Build, ADamagedGzRawlogIsRefused) {
    writeGz(file("l.rawlog"), walls());
    std::string bytes = readText(file("l.rawlog"));
    bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 0x55);
    expectRefused(write("d.rawlog", bytes), {file("d.rawlog") + ": object"});
}

TEST_F(Build, NothingUsableIsRefused) {
    expectRefused(write("n.pcd", asciiPcd("nan nan nan\n", 1)), {"nothing usable", "not finite"});
    expectRefused(write("f.pcd", asciiPcd("90 0 0\n", 1)), {"nothing usable", "out of range"});
    expectRefused(plain("i.rawlog", {atTimeOf<CObservationImage>(0)}),
                  {"nothing usable", "CObservationImage"});
}

TEST_F(Build, ATrajectoryThatDoesNotServeIsRefused) {
    const std::string log = plain("l.rawlog", walls()) + " --trajectory ";
    expectRefused(log + file("none.tum"), {file("none.tum") + ": no such file"});
    expectRefused(log + write("bad.tum", "# time ...\n1 2 3 4 0 0 0 1\n1 2 3\n"),
                  {file("bad.tum") + ":3: expected 8 numbers"});
    expectRefused(log + write("old.tum", "1 2 3 4 0 0 0 1\n"),
                  {file("old.tum") + ": covers no scan"});
    expectRefused(
        write("p.pcd", asciiPcd("2 0 1\n", 1)) + " --frame map --trajectory " + trajectory(),
        {"t.tum: 5 poses (TUM trajectory) for 1 scan", "--times FILE"});
}

TEST_F(Build, SettingsAreCheckedByNameBeforeAnyInputIsRead) {
    for (const char* wrong : {"0", "-1", "nan", "inf"}) {
        expectRefused("none.pcd --resolution " + std::string(wrong), {"resolution = "});
        expectRefused("none.pcd --max-range " + std::string(wrong), {"max_range = "});
        expectRefused("none.pcd --isotropic-length " + std::string(wrong), {"isotropic_length = "});
        expectRefused("none.pcd --max-gap " + std::string(wrong), {"--max-gap"});
    }
    expectRefused("none.pcd --min-range -1", {"min_range = -1"});
    expectRefused("none.pcd --min-range 9", {"max_range = 8", "min_range"});
    expectRefused("none.pcd --resolution 5cm", {"--resolution", "5cm"});
    expectRefused("none.pcd --bandwidth adaptiv", {"--bandwidth", "adaptiv"});
    expectRefused("none.pcd --threads -1", {"--threads"});
    expectRefused("none.pcd --no-such-option", {"--no-such-option"});
    expectRefused("none.pcd --section map", {"--section", "--config"});
    expectRefused("", {"INPUT"});
}

TEST_F(Build, OutputsAreCheckedBeforeAnyInputIsRead) {
    const std::string missing = file("no/such/folder/");
    const auto refused = [&](const std::string& arguments, const std::string& part) {
        const auto run = runProgram("build none.pcd " + arguments);
        EXPECT_EQ(run.exit, 1);
        EXPECT_TRUE(holds(run.err, part)) << run.err;
    };
    refused("-o " + missing + "m.akimap", missing + "m.akimap");
    refused("-o " + folder.path().string(), folder.path().string());
    refused("-o " + file("m.akimap") + " --json " + missing + "m.json", missing + "m.json");
    refused("-o " + file("m.akimap") + " --export " + missing + "m.ply", missing + "m.ply");
    refused("-o " + file("m.akimap") + " --export " + file("m.abc"), "m.abc");
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
    const std::string pcd = write("p.pcd", asciiPcd("2 0 1\n", 1));
    const auto run = runProgram("build " + pcd + " -o " + pcd);
    EXPECT_EQ(run.exit, 1);
    EXPECT_EQ(readText(pcd), asciiPcd("2 0 1\n", 1));
}

}  // namespace
