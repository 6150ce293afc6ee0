// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "guard.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstring>
#include <exception>
#include <stdexcept>

#include "errors.h"

namespace akimap::bench {
namespace {

constexpr unsigned kSeconds = 60;       // until it hangs
constexpr unsigned kSecondsOfWork = 1;  // on the processor, so that a busy one is no matter
constexpr std::size_t kLongest = 70;    // of a reason, in characters

std::string answer(const std::function<std::string()>& work) {
    try {
        return work();
    } catch (const std::exception& e) {
        std::string reason = app::reasonOf(e.what());
        if (reason.size() > kLongest) reason = reason.substr(0, kLongest) + "...";
        return "throws: " + reason;
    } catch (...) {
        return "throws something";
    }
}

[[noreturn]] void child(const std::function<std::string()>& work, int out) {
    const int nowhere = open("/dev/null", O_WRONLY);
    dup2(nowhere, STDOUT_FILENO), dup2(nowhere, STDERR_FILENO);
    alarm(kSeconds);
    const rlimit work_limit{kSecondsOfWork, kSecondsOfWork + 1};
    setrlimit(RLIMIT_CPU, &work_limit);
    const std::string text = answer(work);
    const bool written = write(out, text.data(), text.size()) == static_cast<ssize_t>(text.size());
    _exit(written ? 0 : 1);
}

std::string readAll(int in) {
    std::string text;
    char piece[512];
    for (ssize_t n = 0; (n = read(in, piece, sizeof piece)) > 0;)
        text.append(piece, static_cast<std::size_t>(n));
    return text;
}

std::string ending(int signal) {
    if (signal == SIGALRM) return "hangs";
    if (signal == SIGXCPU) return "no answer within " + std::to_string(kSecondsOfWork) + " s";
    return "crashes: SIG" + std::string(sigabbrev_np(signal));
}

}  // namespace

std::string guarded(const std::function<std::string()>& work) {
    int ends[2];
    if (pipe(ends) != 0) throw std::runtime_error("no pipe to be had");
    const pid_t process = fork();
    if (process < 0) throw std::runtime_error("no process to be had");
    if (process == 0) {
        close(ends[0]);
        child(work, ends[1]);
    }
    close(ends[1]);
    const std::string text = readAll(ends[0]);
    close(ends[0]);
    int status = 0;
    waitpid(process, &status, 0);
    if (WIFSIGNALED(status)) return ending(WTERMSIG(status));
    return WEXITSTATUS(status) == 0 ? text : "ends the program";
}

}  // namespace akimap::bench
