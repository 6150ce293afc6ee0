// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
// Memory of a whole process beside MRPT's COctoMap, loading and saving, and the time that
// `akimap info` takes from start to end.

#include <malloc.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/maps/COctoMap.h>
#include <mrpt/serialization/CArchive.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <functional>
#include <stdexcept>

#include "scenes.h"
#include "timing.h"

using namespace akimap;
using bench::medianCpuSeconds;
using bench::medianSeconds;

namespace {

constexpr int kRounds = 9, kStarts = 21;

/** Runs the work in a process of its own. \return its peak resident memory [MB] */
double peakOf(const std::function<void()>& work) {
    malloc_trim(0);
    const pid_t process = fork();
    if (process < 0) throw std::runtime_error("no process to be had");
    if (process == 0) work(), _exit(0);
    int status = 0;
    struct rusage usage {};
    wait4(process, &status, 0, &usage);
    if (status != 0) throw std::runtime_error("a map's process failed");
    return 1.024e-3 * static_cast<double>(usage.ru_maxrss);
}

/** Of the structured scene: peaks above that of a process with the same scans and no map. */
void memory(const std::vector<std::vector<Ray>>& rays) {
    std::vector<bench::PointCloudScan> scans;
    for (const auto& scan : rays) scans.push_back(bench::asPointCloud(scan));
    const auto insertInto = [&](mrpt::maps::CMetricMap& map) {
        for (const auto& s : scans) map.insertObservation(s.observation, s.robot);
    };
    const auto intoAkiMap = [&](unsigned threads) {
        AkiMap map(0.05);
        map.insertionOptions.threads = threads;
        insertInto(map);
        return map.memoryBytes();
    };
    const double idle = peakOf([] {});
    const double one = peakOf([&] { intoAkiMap(1); }), two = peakOf([&] { intoAkiMap(2); });
    const double octomap = peakOf([&] {
        mrpt::maps::COctoMap map(0.05);
        insertInto(map);
    });
    std::printf("structured, %zu scans: a process's peak memory above that without a map\n",
                scans.size());
    std::printf("  AkiMap, 1 thread   %.1f MB, of them the map %.1f MB\n", one - idle,
                1e-6 * static_cast<double>(intoAkiMap(1)));
    std::printf("  AkiMap, 2 threads  %.1f MB\n", two - idle);
    std::printf("  MRPT COctoMap      %.1f MB\n", octomap - idle);
}

/** MB of cells with evidence, two floats each, in a second of CPU time. */
void storage(const AkiMap& map, const std::string& file) {
    const double megabytes = 8e-6 * static_cast<double>(map.cellCount());
    const auto row = [&](const char* name, double seconds) {
        std::printf("  %-32s %6.0f MB/s\n", name, megabytes / seconds);
    };
    std::printf("loading and saving %.1f MB of cells, by CPU time\n", megabytes);
    row("to memory, MRPT's serialization", medianCpuSeconds(kRounds, [&] {
            mrpt::io::CMemoryStream stream;
            auto archive = mrpt::serialization::archiveFrom(stream);
            archive << map;
        }));
    mrpt::io::CMemoryStream stream;
    auto archive = mrpt::serialization::archiveFrom(stream);
    archive << map;
    row("from memory", medianCpuSeconds(kRounds, [&] {
            stream.Seek(0);
            AkiMap loaded;
            archive >> loaded;
        }));
    row("to a file (.akimap, gz)", medianCpuSeconds(kRounds, [&] { map.saveToFile(file); }));
    row("from a file", medianCpuSeconds(kRounds, [&] { AkiMap::loadFromFile(file); }));
    std::printf("  the file takes %.2f bytes a cell\n",
                static_cast<double>(std::filesystem::file_size(file)) /
                    static_cast<double>(map.cellCount()));
}

void runQuietly(std::vector<std::string> command) {
    std::vector<char*> argv;
    for (std::string& word : command) argv.push_back(word.data());
    argv.push_back(nullptr);
    posix_spawn_file_actions_t quiet;
    posix_spawn_file_actions_init(&quiet);
    posix_spawn_file_actions_addopen(&quiet, STDOUT_FILENO, "/dev/null", 1, 0);
    pid_t process = 0;
    int status = posix_spawnp(&process, argv[0], &quiet, nullptr, argv.data(), environ);
    posix_spawn_file_actions_destroy(&quiet);
    if (status == 0) waitpid(process, &status, 0);
    if (status != 0) throw std::runtime_error(command[0] + " failed");
}

/** CPU time of the processes that were waited for. */
double childrensSeconds() {
    struct rusage usage {};
    getrusage(RUSAGE_CHILDREN, &usage);
    const auto seconds = [](const timeval& t) {
        return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

void startUp(const std::string& file) {
    AkiMap small(0.1);
    small.insertRays(app::simulatedRays({}).front());
    small.saveToFile(file);
    const auto row = [](const std::string& name, const std::vector<std::string>& command) {
        const double before = childrensSeconds();
        const double wall = medianSeconds(kStarts, [&] { runQuietly(command); });
        const double cpu = (childrensSeconds() - before) / kStarts;
        std::printf("  %-26s %6.1f ms (median), %6.1f ms of CPU time (mean)\n", name.c_str(),
                    1e3 * wall, 1e3 * cpu);
    };
    std::printf("from start to end\n");
    row("akimap info, " + std::to_string(small.cellCount()) + " cells",
        {AKIMAP_PROGRAM, "info", file});
    row("MRPT's libraries alone", {AKIMAP_MRPT_NOTHING});
    row("true", {"true"});
}

}  // namespace

int main() try {
    std::setvbuf(stdout, nullptr, _IOLBF, BUFSIZ);
    // Before any thread is started here, which a fork would lose.
    const auto scans = app::simulatedRays({});
    memory(scans);
    const std::string file = (std::filesystem::temp_directory_path() /
                              ("bench_storage" + std::to_string(getpid()) + ".akimap"))
                                 .string();
    AkiMap map(0.05);
    for (const auto& scan : scans) map.insertRays(scan);
    storage(map, file);
    startUp(file);
    std::filesystem::remove(file);
    return 0;
} catch (const std::exception& e) {
    std::fprintf(stderr, "bench_storage: %s\n", e.what());
    return 1;
}
