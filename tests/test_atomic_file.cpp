// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <akimap/AkiMap.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <functional>
#include <thread>

#include "random_scans.h"
#include "run_program.h"
#include "same_map.h"
#include "support/AtomicFile.h"
#include "support/pending_files.h"

using namespace akimap;
namespace fs = std::filesystem;

namespace {

std::size_t filesIn(const TemporaryFolder& folder) {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder.path()), {}));
}

mode_t modeOf(const std::string& file) {
    struct stat status {};
    EXPECT_EQ(stat(file.c_str(), &status), 0) << file;
    return status.st_mode & 07777;
}

std::string failure(const std::function<void()>& work) {
    try {
        work();
        return "";
    } catch (const std::runtime_error& e) {
        return e.what();
    }
}

/** Runs the work in a process of its own. \return how that ended, as waitpid() has it */
int endOf(const std::function<void()>& work) {
    const pid_t process = fork();
    if (process == 0) work(), _exit(0);
    int status = 0;
    waitpid(process, &status, 0);
    return status;
}

AkiMap smallMap(unsigned seed) {
    AkiMap map(0.1);
    EXPECT_TRUE(map.insertRays(test::randomScan(seed, 300)));
    return map;
}

}  // namespace

TEST(AtomicFile, AppearsWholeOrNotAtAll) {
    const TemporaryFolder folder;
    const std::string target = folder.file("a.txt");
    writeText(target, "older");
    {
        const AtomicFile abandoned(target);
        EXPECT_NE(abandoned.path(), target);
        EXPECT_EQ(std::filesystem::path(abandoned.path()).extension(), ".txt");
        writeText(abandoned.path(), "half");
    }
    EXPECT_EQ(readText(target), "older");
    AtomicFile first(target), second(target);
    EXPECT_NE(first.path(), second.path());
    writeText(first.path(), "new");
    first.commit();
    EXPECT_EQ(readText(target), "new");
}

TEST(AtomicFile, WritesThroughALinkAndToADevice) {
    const TemporaryFolder folder;
    writeText(folder.file("real.txt"), "older");
    std::filesystem::create_symlink("real.txt", folder.file("link.txt"));
    AtomicFile through(folder.file("link.txt"));
    writeText(through.path(), "new");
    through.commit();
    EXPECT_TRUE(std::filesystem::is_symlink(folder.file("link.txt")));
    EXPECT_EQ(readText(folder.file("real.txt")), "new");
    AtomicFile device("/dev/null");
    writeText(device.path(), "gone");
    device.commit();
    EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST(AtomicFile, FollowsALinkToAFileThatIsNotThereYet) {
    const TemporaryFolder folder;
    fs::create_symlink("new.txt", folder.file("link.txt"));
    writeWhole(folder.file("link.txt"), "new");
    EXPECT_TRUE(fs::is_symlink(folder.file("link.txt")));
    EXPECT_EQ(readText(folder.file("new.txt")), "new");
}

TEST(AtomicFile, WritesThroughAPipe) {
    const TemporaryFolder folder;
    const std::string pipe = folder.file("pipe");
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    std::string got;
    std::thread reader([&] { got = readText(pipe); });
    writeWhole(pipe, "through");
    reader.join();
    EXPECT_EQ(got, "through");
    EXPECT_TRUE(fs::is_fifo(pipe));
    EXPECT_EQ(filesIn(folder), 1u);
}

TEST(AtomicFile, KeepsTheModeOfWhatItReplacesFromTheStart) {
    const TemporaryFolder folder;
    const mode_t mask = umask(0);
    umask(mask);
    writeWhole(folder.file("new"), "");
    EXPECT_EQ(modeOf(folder.file("new")), 0666 & ~mask);
    for (const mode_t mode : {0600u, 0640u, 0755u}) {
        ASSERT_EQ(chmod(folder.file("new").c_str(), mode), 0);
        AtomicFile file(folder.file("new"));
        EXPECT_EQ(modeOf(file.path()), mode);
        file.commit();
        EXPECT_EQ(modeOf(folder.file("new")), mode);
    }
}

TEST(AtomicFile, KeepsTheOwnerWhereItMay) {
    if (geteuid() != 0) GTEST_SKIP() << "only root may give files away";
    const TemporaryFolder folder;
    const std::string file = folder.file("theirs");
    writeText(file, "older");
    ASSERT_EQ(chown(file.c_str(), 1234, 5678), 0);
    writeWhole(file, "new");
    struct stat status {};
    ASSERT_EQ(stat(file.c_str(), &status), 0);
    EXPECT_EQ(status.st_uid, 1234u);
    EXPECT_EQ(status.st_gid, 5678u);
}

TEST(AtomicFile, NamesNeedNoRoomForItsOwn) {
    const TemporaryFolder folder;
    const std::string longest = folder.file(std::string(255, 'x'));
    writeWhole(longest, "all");
    EXPECT_EQ(readText(longest), "all");
    const std::string too_long = folder.file(std::string(256, 'x'));
    EXPECT_EQ(failure([&] { AtomicFile::checkWritable(too_long); }),
              "cannot write '" + too_long + "': File name too long");
}

TEST(AtomicFile, ErrorsNameTheFileAskedForAndTheReason) {
    const TemporaryFolder folder;
    const auto expect = [](const std::string& file, const std::string& why) {
        const std::string all = "cannot write '" + file + "': " + why;
        EXPECT_EQ(failure([&] { writeWhole(file, "x"); }), all);
        EXPECT_EQ(failure([&] { smallMap(1).saveToFile(file); }), all);
    };
    expect(folder.file("none/m.akimap"), "No such file or directory");
    expect(folder.path().string(), "it is a folder");
    expect("", "the file has no name");
    if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
    expect("/dev/full", "No space left on device");
    fs::create_symlink("/dev/full", folder.file("full.akimap"));
    expect(folder.file("full.akimap"), "No space left on device");
}

TEST(AtomicFile, OfTwoThreadsThatSaveOnePathOneWins) {
    const TemporaryFolder folder;
    const std::string file = folder.file("m.akimap");
    const AkiMap maps[2] = {smallMap(1), smallMap(2)};
    const std::string prints[2] = {test::fingerprint(maps[0]), test::fingerprint(maps[1])};
    for (int round = 0; round < 10; round++) {
        std::thread other([&] { maps[1].saveToFile(file); });
        maps[0].saveToFile(file);
        other.join();
        const std::string print = test::fingerprint(*AkiMap::loadFromFile(file));
        EXPECT_TRUE(print == prints[0] || print == prints[1]);
    }
    EXPECT_EQ(filesIn(folder), 1u);
}

TEST(PendingFiles, ASignalRemovesThemAndEndsTheProcess) {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        const TemporaryFolder folder;
        const int status = endOf([&] {
            std::signal(signal, SIG_DFL);
            removePendingFilesOnSignals();
            const AtomicFile one(folder.file("one")), two(folder.file("two"));
            if (filesIn(folder) == 2) raise(signal);
        });
        EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == signal) << status;
        EXPECT_EQ(filesIn(folder), 0u);
    }
}

TEST(PendingFiles, SignalsThatAreIgnoredStayIgnored) {
    const int status = endOf([] {
        std::signal(SIGHUP, SIG_IGN);
        removePendingFilesOnSignals();
        raise(SIGHUP);
        _exit(7);
    });
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 7) << status;
}

TEST(PendingFiles, OfTheLibraryAreKnownToTheProgram) {
    const TemporaryFolder folder;
    const AkiMap map = smallMap(1);
    const int status = endOf([&] {
        std::signal(SIGXFSZ, endBySignal);  // comes while the map is written
        const struct rlimit small { 100, 100 };
        setrlimit(RLIMIT_FSIZE, &small);
        map.saveToFile(folder.file("m.akimap"));
    });
    EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGXFSZ) << status;
    EXPECT_EQ(filesIn(folder), 0u);
}

TEST(PendingFiles, AStoppedProgramLeavesNone) {
    const TemporaryFolder folder;
    AkiMap map(0.02);
    for (unsigned seed = 1; seed <= 3; seed++) map.insertRays(test::randomScan(seed, 3000));
    map.saveToFile(folder.file("m.akimap"));
    const pid_t program = fork();
    if (program == 0) {
        execl(AKIMAP_PROGRAM, "akimap", "export", folder.file("m.akimap").c_str(),
              folder.file("m.csv").c_str(), nullptr);
        _exit(127);
    }
    int status = 0;
    while (filesIn(folder) < 2 && waitpid(program, &status, WNOHANG) == 0) usleep(100);
    kill(program, SIGTERM);  // while the cells are written
    waitpid(program, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGTERM) << status;
    EXPECT_EQ(filesIn(folder), 1u);
}

TEST(PendingFiles, CommittedAndAbandonedOnesAreForgotten) {
    const TemporaryFolder folder;
    writeWhole(folder.file("kept"), "kept");
    { const AtomicFile abandoned(folder.file("gone")); }
    removePendingFiles();
    EXPECT_EQ(readText(folder.file("kept")), "kept");
    EXPECT_EQ(filesIn(folder), 1u);
}
