// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
// Not for users: `akimap slam` and `akimap localize` run it.
#include "cli.h"
#include "slam_commands.h"

int main(int argc, char** argv) {
    return akimap::app::runCommands(argc, argv, {akimap::app::addSlam, akimap::app::addLocalize});
}
