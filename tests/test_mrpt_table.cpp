// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
// What AkiMap answers wherever MRPT calls it, and that doc/mrpt.md shows what this MRPT's maps do.
#include <gtest/gtest.h>

#include <sstream>
#include <vector>

#include "run_program.h"

namespace {

const std::string kDoc = std::string(AKIMAP_SOURCE_DIR) + "/doc/mrpt.md";

/** From the heading of one version to that of the next, without blank lines. */
std::vector<std::string> linesOf(const std::string& text, const std::string& heading) {
    std::vector<std::string> lines;
    std::istringstream in(text);
    bool is_inside = false;
    for (std::string line; std::getline(in, line);) {
        if (line.rfind("## ", 0) == 0) is_inside = line == heading;
        if (is_inside && !line.empty()) lines.push_back(line);
    }
    return lines;
}

std::vector<std::string> cellsOf(const std::string& row) {
    std::vector<std::string> cells;
    std::istringstream in(row.substr(1));
    for (std::string cell; std::getline(in, cell, '|');) cells.push_back(cell);
    return cells;
}

bool isFailure(const std::string& answer) {
    for (const char* bad :
         {" throws",    " crashes",   " hangs",    " aborts",           " fails",  " ends",
          "nothing",    "no surface", "misplaced", "as good or better", " wrong",  " loses",
          "not finite", "no files",   "no map",    "does not",          "changes", "not one",
          "finds some", "always 0",   "no answer"})
        if (answer.find(bad) != std::string::npos) return true;
    return false;
}

}  // namespace

TEST(MrptTable, NoCallOfAnAkiMapFailsAndTheDocShowsThem) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "a sanitized library can't be loaded into programs that are not";
#endif
    const ::Run run = runCommand(std::string("'") + AKIMAP_MRPT_TABLE + "'");
    ASSERT_EQ(run.exit, 0) << run.err;
    const std::string heading = run.out.substr(0, run.out.find('\n'));
    const auto lines = linesOf(run.out, heading);
    int rows = 0;
    for (const std::string& line : lines) {
        if (line[0] != '|' || line.rfind("| |", 0) == 0 || line.rfind("|---", 0) == 0) continue;
        rows++;
        const auto cells = cellsOf(line);
        ASSERT_GE(cells.size(), 4u) << line;
        // It matches scans against a points map or a 2D grid, whatever stands beside it.
        if (cells[0] == " `icp-slam` alone ") continue;
        EXPECT_FALSE(isFailure(cells[1])) << line;
    }
    EXPECT_GT(rows, 50);

    const auto documented = linesOf(readText(kDoc), heading);
    if (documented.empty()) GTEST_SKIP() << kDoc << " has no part \"" << heading << "\"";
    ASSERT_EQ(documented.size(), lines.size()) << "make doc-mrpt writes it anew";
    for (std::size_t i = 0; i < lines.size(); i++)
        EXPECT_EQ(documented[i], lines[i]) << "make doc-mrpt writes it anew";
}
