// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "run_program.h"

/** The real program in the background; its output goes to files. */
class Background {
 public:
    Background(const std::string& arguments, std::string output) : output_(std::move(output)) {
        const std::string command = std::string("exec '") + AKIMAP_PROGRAM + "' " + arguments +
                                    " >'" + output_ + ".out' 2>'" + output_ + ".err' </dev/null";
        process_ = fork();
        if (process_ == 0) {
            execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
            _exit(127);
        }
    }
    ~Background() {
        if (process_ > 0) kill(process_, SIGKILL), waitpid(process_, nullptr, 0);
    }
    Background(const Background&) = delete;
    Background& operator=(const Background&) = delete;

    void interrupt() const { kill(process_, SIGINT); }
    void terminate() const { kill(process_, SIGTERM); }
    void hangUp() const { kill(process_, SIGHUP); }
    /** How far into the file it has read; -1 if the file is not open. */
    [[nodiscard]] long readingPosition(const std::string& file) const {
        const std::string proc = "/proc/" + std::to_string(process_);
        std::error_code ignored;
        for (const auto& entry : std::filesystem::directory_iterator(proc + "/fd", ignored)) {
            if (std::filesystem::read_symlink(entry.path(), ignored) != file) continue;
            std::ifstream info(proc + "/fdinfo/" + entry.path().filename().string());
            std::string word;
            long position = -1;
            info >> word >> position;
            return position;
        }
        return -1;
    }
    [[nodiscard]] ::Run wait() {
        int status = 0;
        waitpid(process_, &status, 0);
        process_ = -1;
        const int exit = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
        ::Run run{exit, readText(output_ + ".out"), readText(output_ + ".err")};
        expectNoSanitizerReport(run);
        return run;
    }

 private:
    std::string output_;
    pid_t process_ = -1;
};
