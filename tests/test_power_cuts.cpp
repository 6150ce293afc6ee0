// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
// What is on the disk if the power fails or the program is killed while a map is saved. The test's
// own fsync() and rename() keep a model of a disk that forgets all that was not flushed.
#include <akimap/AkiMap.h>
#include <gtest/gtest.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <map>
#include <random>
#include <set>

#include "random_scans.h"
#include "run_program.h"
#include "same_map.h"

using namespace akimap;
namespace fs = std::filesystem;

namespace {

/** A disk in the worst order: of a file it has what was there at its last flush, of a folder any
 * of the names since its last. */
struct Disk {
    std::map<std::string, std::string> flushed;  ///< content by path
    std::map<std::string, std::string> renamed;  ///< the newest by path, until its folder's flush
    std::map<std::string, std::string> certain;  ///< content by path, once its folder is flushed
    std::set<std::string> possible;              ///< contents that a cut could have left
    bool is_watched = false;
};
Disk disk;

}  // namespace

extern "C" int fsync(int file) {
    if (disk.is_watched) {
        const fs::path path = fs::read_symlink("/proc/self/fd/" + std::to_string(file));
        if (fs::is_regular_file(path)) disk.flushed[path.string()] = readText(path.string());
        if (fs::is_directory(path))
            for (auto at = disk.renamed.begin(); at != disk.renamed.end();) {
                if (fs::path(at->first).parent_path() != path) {
                    ++at;
                    continue;
                }
                disk.certain[at->first] = at->second;
                at = disk.renamed.erase(at);
            }
    }
    return static_cast<int>(syscall(SYS_fsync, file));
}

extern "C" int rename(const char* from, const char* to) noexcept {
    if (disk.is_watched) {
        const std::string content = disk.flushed.count(from) ? disk.flushed[from] : "";
        disk.possible.insert(content);
        disk.renamed[to] = content;
    }
    return static_cast<int>(syscall(SYS_rename, from, to));
}

namespace {

std::vector<AkiMap> twoMaps() {
    std::vector<AkiMap> maps;
    for (unsigned seed = 1; seed <= 2; seed++) {
        maps.emplace_back(0.1);
        EXPECT_TRUE(maps.back().insertRays(test::randomScan(seed, 400)));
    }
    return maps;
}

}  // namespace

TEST(PowerCuts, LeaveTheOlderMapOrTheNewerOne) {
    const TemporaryFolder folder;
    const std::string file = fs::canonical(folder.path()) / "m.akimap";
    const auto maps = twoMaps();
    maps[0].saveToFile(file);
    const std::string older = readText(file);
    disk.is_watched = true;
    for (std::size_t i = 1; i <= 25; i++) {
        maps[i % 2].saveToFile(file);
        EXPECT_EQ(disk.certain[file], readText(file)) << "not flushed when it returned";
    }
    disk.is_watched = false;
    EXPECT_EQ(disk.possible, (std::set<std::string>{older, readText(file)})) << "part of a map";
}

TEST(Kills, LeaveTheOlderMapOrTheNewerOne) {
    const TemporaryFolder folder;
    const std::string file = folder.file("m.akimap");
    const auto maps = twoMaps();
    const std::set<std::string> prints{test::fingerprint(maps[0]), test::fingerprint(maps[1])};
    maps[0].saveToFile(file);
    std::mt19937 random(1);
    for (int round = 0; round < 200; round++) {
        const pid_t writer = fork();
        if (writer == 0) {
            for (std::size_t i = 0;; i++) maps[i % 2].saveToFile(file);
        }
        usleep(static_cast<useconds_t>(random() % 10000));
        kill(writer, SIGKILL);
        waitpid(writer, nullptr, 0);
        ASSERT_EQ(prints.count(test::fingerprint(*AkiMap::loadFromFile(file))), 1u) << round;
    }
}
