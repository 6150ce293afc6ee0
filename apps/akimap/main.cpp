// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <iostream>

#include "cli.h"
#include "commands/commands.h"

namespace {

using namespace akimap::app;

// MRPT's SLAM programs bring libraries that take longer to load than most commands take to run:
// these two live in a program of their own beside this one.
constexpr const char* kSlamProgram = "akimap-slam";

void addSlamNames(CLI::App& app) {
    app.add_subcommand("slam", "Run MRPT's ICP or RBPF SLAM on a rawlog, with an AkiMap");
    app.add_subcommand("localize",
                       "Run MRPT's Monte-Carlo localization on a rawlog, with an AkiMap");
}

int runSlamProgram(char** argv) {
    const auto program =
        std::filesystem::read_symlink("/proc/self/exe").parent_path() / kSlamProgram;
    execv(program.c_str(), argv);
    std::cerr << "akimap: " << program.string() << ": can't be run: " << std::strerror(errno)
              << "\n";
    return 1;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc > 1 && (!std::strcmp(argv[1], "slam") || !std::strcmp(argv[1], "localize")))
        return runSlamProgram(argv);
    return runCommands(argc, argv,
                       {addBuild, addCheck, addConvert, addSimulate, addExport, addInfo, addQuery,
                        addEval, addHoldout, addSlamNames, addDefaultConfig});
}
