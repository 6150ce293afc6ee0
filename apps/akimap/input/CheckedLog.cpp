// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "input/CheckedLog.h"

#include <akimap/rays.h>
#include <fcntl.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CRawlog.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <new>
#include <stdexcept>

#include "errors.h"
#include "input/ObjectReader.h"
#include "input/files.h"

namespace akimap::app {

namespace {

using namespace mrpt::obs;
using Visit = std::function<void(const CObservation&)>;

[[noreturn]] void refuseMissing(const char* what) {
    throw std::runtime_error(std::string("damaged: ") + what + " is missing");
}

/** All observations in an object; what MRPT follows without a look must be there. */
void forEachObservation(const mrpt::rtti::CObject& object, const Visit& visit) {
    if (const auto* observation = dynamic_cast<const CObservation*>(&object)) {
        visit(*observation);
    } else if (const auto* frame = dynamic_cast<const CSensoryFrame*>(&object)) {
        for (const auto& one : *frame)
            one ? visit(*one) : refuseMissing("an observation of a frame");
    } else if (const auto* actions = dynamic_cast<const CActionCollection*>(&object)) {
        for (const auto& action : *actions)
            if (!action) refuseMissing("an action of a collection");
    } else if (const auto* log = dynamic_cast<const CRawlog*>(&object)) {
        for (std::size_t i = 0; i < log->size(); i++) {
            const auto entry = log->getAsGeneric(i);
            entry ? forEachObservation(*entry, visit) : refuseMissing("an object of the log");
        }
    } else if (const auto* map = dynamic_cast<const mrpt::maps::CSimpleMap*>(&object)) {
        for (const auto& keyframe : *map)
            if (keyframe.sf) forEachObservation(*keyframe.sf, visit);
    }
}

/** Does with a scan what a map does before it inserts it. What is thrown is not the log's fault, as
 * the scan may be one that is not wanted. */
void decode(const CObservation& observation) try {
    const mrpt::poses::CPose3D origin;
    (void)raysOf(
        observation, [&](mrpt::Clock::time_point) { return std::optional(origin); }, true);
    observation.unload();
} catch (const std::exception&) {
}

/** What the reading process leaves for the one that waits for it. */
struct Verdict {
    bool is_done;
    std::size_t objects;  ///< read without harm
    char failure[4000];
};

class SharedVerdict {
 public:
    SharedVerdict()
        : memory_(mmap(nullptr, sizeof(Verdict), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS,
                       -1, 0)) {
        if (memory_ == MAP_FAILED) throw std::bad_alloc();
    }
    ~SharedVerdict() { munmap(memory_, sizeof(Verdict)); }
    SharedVerdict(const SharedVerdict&) = delete;
    SharedVerdict& operator=(const SharedVerdict&) = delete;
    Verdict& operator*() const { return *static_cast<Verdict*>(memory_); }
    Verdict* operator->() const { return static_cast<Verdict*>(memory_); }

 private:
    void* memory_;
};

/** More than any log takes that is what it says: an object in memory is about as large as it is
 * unpacked. Not under sanitizers, which reserve the whole address space for themselves. */
void limitMemory(const std::string& file) {
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
    constexpr rlim_t kBase = rlim_t{256} << 20, kTimesPacked = 256;  // [bytes], [-]
    rlim_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    const rlim_t now = pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE));
    struct rlimit limit {};
    getrlimit(RLIMIT_AS, &limit);
    limit.rlim_cur =
        std::min(limit.rlim_cur, now + kBase + kTimesPacked * std::filesystem::file_size(file));
    setrlimit(RLIMIT_AS, &limit);
#else
    static_cast<void>(file);
#endif
}

/** What this process inherited and must not use: the terminal, the signals' handlers, its parent's
 * right to leave a core. */
void retire(pid_t parent) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(1);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, SIG_IGN);
    for (const int signal : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL})
        std::signal(signal, SIG_DFL);
    const struct rlimit none {};
    setrlimit(RLIMIT_CORE, &none);
    const int nowhere = open("/dev/null", O_RDWR | O_CLOEXEC);
    for (const int stream : {STDOUT_FILENO, STDERR_FILENO}) dup2(nowhere, stream);
}

/** The whole life of the reading process. */
void read(const std::string& file, ExternalFiles external_files, Verdict& verdict) try {
    limitMemory(file);
    ObjectReader reader(file, wholeFile(file));
    while (const auto object = reader.next()) {
        try {
            checkObject(*object, file, external_files);
        } catch (const std::exception& e) {
            throw std::runtime_error(file + ": object " + std::to_string(reader.objectsRead()) +
                                     ": " + reasonOf(e.what()));
        }
        forEachObservation(*object, decode);
        verdict.objects = reader.objectsRead();
    }
} catch (const CutFile&) {
} catch (const std::exception& e) {
    std::strncpy(verdict.failure, e.what(), sizeof verdict.failure - 1);
}

}  // namespace

void checkObject(const mrpt::rtti::CObject& object, const std::string& log_file,
                 ExternalFiles external_files) {
    forEachObservation(object, [&](const CObservation& observation) {
        checkExternalFiles(observation, log_file, external_files);
    });
}

CheckedLog::CheckedLog(const std::string& file, ExternalFiles external_files) : file_(file) {
    requireReadable(file);
    findExternalFiles(file);
    const SharedVerdict verdict;
    const pid_t parent = getpid(), reader = fork();
    if (reader < 0) throw std::runtime_error(file + ": can't be checked: " + std::strerror(errno));
    if (reader == 0) {
        retire(parent);
        read(file, external_files, *verdict);
        verdict->is_done = true;
        _exit(0);
    }
    while (waitpid(reader, nullptr, 0) < 0 && errno == EINTR) {
    }
    if (verdict->failure[0]) throw std::runtime_error(verdict->failure);
    if (!verdict->is_done)
        throw std::runtime_error(file + ": object " + std::to_string(verdict->objects + 1) +
                                 ": damaged: MRPT does not survive reading it");
}

}  // namespace akimap::app
