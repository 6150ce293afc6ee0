// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers

// Installs the project, and builds and runs a stranger's project against it.
#include <gtest/gtest.h>

#include <sstream>

#include "run_program.h"

namespace {

namespace fs = std::filesystem;

fs::path buildFolder() {
    return fs::path(AKIMAP_LIBRARY).parent_path().parent_path();
}

/** A variable of this build's CMake cache. */
std::string cached(const std::string& variable) {
    std::istringstream cache(readText(buildFolder() / "CMakeCache.txt"));
    for (std::string line; std::getline(cache, line);)
        if (line.rfind(variable + ":", 0) == 0) return line.substr(line.find('=') + 1);
    return "";
}

std::string inQuotes(const fs::path& path) {
    return "'" + path.string() + "'";
}

bool exists(const fs::path& path) {
    return fs::exists(path);
}

class Consumer : public testing::Test {
 protected:
    /** Installs into prefix() as a package would, away from the configured prefix. */
    void install() {
        const auto run = runCommand("cmake --install " + inQuotes(buildFolder()) + " --prefix " +
                                    inQuotes(prefix()));
        ASSERT_EQ(run.exit, 0) << run.err;
    }
    /** Builds tests/consumer against the akimap under `where`, and runs it with the INI. */
    ::Run buildAndRun(const fs::path& where, const fs::path& ini) {
        const fs::path build = folder_.path() / "consumer";
        // A sanitized library can be loaded by a sanitized program only.
        const std::string sanitize = cached("AKIMAP_SANITIZE");
        const std::string flags =
            sanitize.empty() ? "" : " -DCMAKE_CXX_FLAGS=-fsanitize=" + sanitize;
        const auto built = runCommand(
            "cmake -S " + inQuotes(fs::path(AKIMAP_SOURCE_DIR) / "tests/consumer") + " -B " +
            inQuotes(build) + " -DCMAKE_CXX_COMPILER=" + inQuotes(cached("CMAKE_CXX_COMPILER")) +
            " -DCMAKE_CXX_COMPILER_LAUNCHER=" + inQuotes(cached("CMAKE_CXX_COMPILER_LAUNCHER")) +
            " -DCMAKE_FIND_PACKAGE_PREFER_CONFIG=ON -DCMAKE_PREFIX_PATH=" + inQuotes(where) +
            flags + " && cmake --build " + inQuotes(build));
        EXPECT_EQ(built.exit, 0) << built.out << built.err;
        EXPECT_EQ(built.err, "") << "a warning of CMake's or the compiler's";
        return runCommand(inQuotes(build / "consumer") + " " + inQuotes(ini) +
                          " MappingApplication");
    }
    [[nodiscard]] fs::path prefix() const { return folder_.path() / "the prefix"; }

    TemporaryFolder folder_;
};

constexpr const char* kAllWell =
    "own map: wall occupied, before free, behind unknown\n"
    "map of the INI: wall occupied, before free, behind unknown\n"
    "its copy: wall occupied, before free, behind unknown\n";

TEST_F(Consumer, BuildsAndRunsAgainstTheInstalledTree) {
    install();
    const auto run = buildAndRun(prefix(), prefix() / "share/akimap/akimap.ini");
    EXPECT_EQ(run.exit, 0) << run.err;
    EXPECT_EQ(run.out, kAllWell);
    EXPECT_EQ(run.err, "");
}

TEST_F(Consumer, BuildsAndRunsAgainstTheBuildTree) {
    const auto run =
        buildAndRun(buildFolder(), fs::path(AKIMAP_SOURCE_DIR) / "share/akimap/akimap.ini");
    EXPECT_EQ(run.exit, 0) << run.err;
    EXPECT_EQ(run.out, kAllWell);
}

TEST_F(Consumer, TheInstalledProgramFindsTheInstalledLibrary) {
    install();
    const std::string akimap = inQuotes(prefix() / "bin/akimap");
    const auto libraries = runCommand("env -u LD_LIBRARY_PATH ldd " + akimap);
    EXPECT_NE(libraries.out.find(fs::canonical(prefix()).string() + "/"), std::string::npos)
        << "not the installed library:\n"
        << libraries.out;
    const auto run = runCommand(akimap + " --version");
    EXPECT_EQ(run.exit, 0) << run.err;
    EXPECT_EQ(run.out, runProgram("--version").out);
}

TEST_F(Consumer, AnInstallationHoldsEveryPublicHeaderAndIniAndNothingOfTheBuild) {
    install();
    const fs::path source = AKIMAP_SOURCE_DIR;
    for (const auto& entry : fs::directory_iterator(source / "libs/akimap/include/akimap"))
        EXPECT_PRED1(exists, prefix() / "include/akimap" / entry.path().filename());
    for (const auto& entry : fs::recursive_directory_iterator(source / "share")) {
        const fs::path installed =
            prefix() / "share" / entry.path().lexically_relative(source / "share");
        if (entry.path().extension() == ".ini") {
            EXPECT_PRED1(exists, installed);
        }
    }
    for (const auto& entry : fs::recursive_directory_iterator(prefix()))
        if (entry.path().extension() == ".cmake") {
            const std::string text = readText(entry.path());
            EXPECT_EQ(text.find(buildFolder().string() + "/"), std::string::npos) << entry.path();
            EXPECT_EQ(text.find(source.string() + "/"), std::string::npos) << entry.path();
        }
}

TEST_F(Consumer, AWrongVersionIsRefused) {
    writeText(folder_.file("CMakeLists.txt"),
              "cmake_minimum_required(VERSION 3.22)\nproject(p LANGUAGES CXX)\n"
              "find_package(akimap 99 REQUIRED)\n");
    const auto run =
        runCommand("cmake -S " + inQuotes(folder_.path()) + " -B " + inQuotes(folder_.file("b")) +
                   " -DCMAKE_PREFIX_PATH=" + inQuotes(buildFolder()));
    EXPECT_NE(run.exit, 0);
    EXPECT_NE(run.err.find("99"), std::string::npos) << run.err;
}

}  // namespace
