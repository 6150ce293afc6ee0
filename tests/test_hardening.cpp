// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
// How the programs and the library are built, read from their files.
#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>
#include <vector>

#include "run_program.h"
#include "sanitized.h"

namespace fs = std::filesystem;

namespace {

const fs::path kBin = fs::path(AKIMAP_PROGRAM).parent_path();

std::vector<fs::path> delivered() {
    return {AKIMAP_PROGRAM, kBin / "akimap-slam", AKIMAP_LIBRARY};
}

std::string readelf(const std::string& options, const fs::path& file) {
    const auto run = runCommand("LC_ALL=C readelf -W " + options + " '" + file.string() + "'");
    EXPECT_EQ(run.exit, 0) << run.err;
    return run.out;
}

std::string lineWith(const std::string& mark, const std::string& text) {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);)
        if (line.find(mark) != std::string::npos) return line;
    return "";
}

bool holds(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

/** The folders that the loader looks for a file's libraries in, as the file has them. */
std::vector<std::string> libraryFolders(const fs::path& file) {
    const std::string line = lineWith("PATH)", readelf("-d", file));  // RPATH or RUNPATH
    if (line.empty()) return {};
    const auto begin = line.find('[') + 1;
    std::istringstream list(line.substr(begin, line.rfind(']') - begin) + ":");
    std::vector<std::string> folders;
    for (std::string folder; std::getline(list, folder, ':');) folders.push_back(folder);
    return folders;
}

}  // namespace

TEST(Hardening, LibrariesAreNotLookedForInTheCurrentFolder) {
    std::vector<fs::path> files = delivered();
    for (const auto& entry : fs::directory_iterator(kBin)) files.push_back(entry.path());
    for (const fs::path& file : files)
        for (const std::string& folder : libraryFolders(file))
            EXPECT_TRUE(folder.rfind('/', 0) == 0 || folder.rfind("$ORIGIN/", 0) == 0)
                << file << ": '" << folder << "'";
}

TEST(Hardening, WhatLiesInTheCurrentFolderIsNotLoaded) {
    const TemporaryFolder folder;
    for (const char* program : {"akimap", "akimap-slam"}) {
        std::istringstream libraries(readelf("-d", AKIMAP_LIBRARY) + readelf("-d", kBin / program));
        for (std::string line; std::getline(libraries, line);)
            if (holds(line, "(NEEDED)")) {
                const auto begin = line.find('[') + 1;
                writeText(folder.file(line.substr(begin, line.find(']') - begin)), "no library");
            }
        const auto run = runCommand("cd '" + folder.path().string() + "' && '" +
                                    (kBin / program).string() + "' --version");
        EXPECT_EQ(run.exit, 0) << run.err;
    }
}

TEST(Hardening, TablesOfAddressesAreReadOnlyBeforeMain) {
    for (const fs::path& file : delivered()) {
        EXPECT_TRUE(holds(readelf("-l", file), "GNU_RELRO")) << file;
        EXPECT_TRUE(holds(lineWith("(FLAGS_1)", readelf("-d", file)), "NOW")) << file;
    }
}

TEST(Hardening, ProgramsLieAnywhereAndNoStackIsCode) {
    for (const fs::path& file : delivered()) {
        EXPECT_TRUE(holds(lineWith("Type:", readelf("-h", file)), "DYN")) << file;
        const std::string stack = lineWith("GNU_STACK", readelf("-l", file));
        EXPECT_TRUE(holds(stack, " RW ")) << file << ": " << stack;
        EXPECT_FALSE(holds(readelf("-d", file), "TEXTREL")) << file;
    }
}

TEST(Hardening, StacksAndCopiesAreGuarded) {
    for (const fs::path& file : delivered()) {
        const std::string symbols = readelf("--dyn-syms", file);
        EXPECT_TRUE(holds(symbols, "__stack_chk_fail")) << file;
        if (sanitized()) continue;  // which have checks of their own
        EXPECT_TRUE(holds(symbols, "_chk@GLIBC")) << file << " has no fortified call";
    }
}
