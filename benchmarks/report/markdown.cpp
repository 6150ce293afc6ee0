// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "report/markdown.h"

#include <mrpt/system/os.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iomanip>
#include <sstream>
#include <thread>

namespace akimap::bench {
namespace {

/** Columns on a screen of UTF-8 text. */
std::size_t widthOf(const std::string& text) {
    return static_cast<std::size_t>(
        std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xc0) != 0x80; }));
}

std::string processor() {
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; std::getline(info, line);)
        if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
    return "an unknown processor";
}

}  // namespace

std::string MarkdownTable::text() const {
    std::vector<std::size_t> widths(rows_.front().size(), 3);
    for (const auto& row : rows_)
        for (std::size_t i = 0; i < row.size(); i++)
            widths[i] = std::max(widths[i], widthOf(row[i]));
    std::ostringstream out;
    const auto write = [&](const std::vector<std::string>& row) {
        for (std::size_t i = 0; i < row.size(); i++) {
            const std::string pad(widths[i] - widthOf(row[i]), ' ');
            out << "| " << (i == 0 ? row[i] + pad : pad + row[i]) << ' ';
        }
        out << "|\n";
    };
    write(rows_.front());
    for (std::size_t i = 0; i < widths.size(); i++)
        out << '|' << (i == 0 ? ":" : "-") << std::string(widths[i], '-') << (i == 0 ? "-" : ":");
    out << "|\n";
    std::for_each(rows_.begin() + 1, rows_.end(), write);
    return out.str();
}

std::string fixed(double value, int decimals) {
    if (!std::isfinite(value)) return "–";
    std::ostringstream out;
    out << std::fixed << std::setprecision(decimals) << value;
    return out.str();
}

std::string bold(const std::string& text) {
    return "**" + text + "**";
}

std::string image(const std::string& alternative, const std::string& path) {
    return "![" + alternative + "](" + path + ")\n";
}

std::string describeMachine() {
    std::ostringstream out;
    out << processor() << ", " << std::thread::hardware_concurrency() << " cores; GCC "
        << __VERSION__ << ", " << mrpt::system::MRPT_getVersion();
    return out.str();
}

}  // namespace akimap::bench
