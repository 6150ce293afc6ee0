// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

/** A folder of its own for one test, removed with everything in it. */
class TemporaryFolder {
 public:
    TemporaryFolder() {
        std::string name = (std::filesystem::temp_directory_path() / "akimap-test-XXXXXX").string();
        if (!mkdtemp(name.data())) throw std::runtime_error("can't make " + name);
        path_ = name;
    }
    ~TemporaryFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    [[nodiscard]] std::string file(const std::string& name) const {
        return (path_ / name).string();
    }

 private:
    std::filesystem::path path_;
};

[[nodiscard]] inline std::string readText(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    if (!in) throw std::runtime_error("can't read " + file);
    return {std::istreambuf_iterator<char>(in), {}};
}

inline void writeText(const std::string& file, const std::string& text) {
    std::ofstream out(file, std::ios::binary);
    out << text;
    out.close();
    if (!out) throw std::runtime_error("can't write " + file);
}

/** What a program left behind. In a TEST_F say auto or ::Run: gtest's fixtures have a Run too. */
struct Run {
    int exit;  ///< its exit status; 128 + the signal's number if a signal ended it
    std::string out, err;
};

/** Throws if a sanitizer stopped the program: its exit status, 1, passes for a refusal. */
inline void expectNoSanitizerReport(const Run& run) {
    for (const char* mark : {"Sanitizer: ", "Sanitizer:DEADLYSIGNAL", ": runtime error: "})
        if (run.err.find(mark) != std::string::npos) throw std::runtime_error(run.err);
}

/** Runs a command line through the shell; arguments with blanks or * need quotes of their own. */
[[nodiscard]] inline Run runCommand(const std::string& command) {
    const TemporaryFolder folder;
    const std::string out = folder.file("out"), err = folder.file("err");
    const int status =
        std::system(("( " + command + " ) >'" + out + "' 2>'" + err + "' </dev/null").c_str());
    const int exit = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    Run run{exit, readText(out), readText(err)};
    expectNoSanitizerReport(run);
    return run;
}

#ifdef AKIMAP_PROGRAM
/** Runs the akimap program as a user would, e.g. runProgram("info 'my map.akimap'"). */
[[nodiscard]] inline Run runProgram(const std::string& arguments) {
    return runCommand(std::string("'") + AKIMAP_PROGRAM + "' " + arguments);
}
#endif
