// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <charconv>
#include <fstream>

#include "output/formats.h"
#include "support/stream.h"

namespace akimap::app {

namespace {

/** Appends the number in 9 significant digits and a separator. Not by printf: it is several
 * times slower, and writes commas in some locales. */
void append(std::string& row, double value, char separator) {
    char text[32];
    const auto end = std::to_chars(text, text + sizeof(text), value, std::chars_format::general, 9);
    row.append(text, end.ptr);
    row += separator;
}

}  // namespace

void writeCsv(const AkiMap& map, const std::string& path) {
    std::ofstream out = openForWriting(path);
    out << "x,y,z,occupancy,alpha,beta\n";
    std::string row;
    map.forEachCell([&](const Cell& c) {
        row.clear();
        for (const double v : {c.x, c.y, c.z, c.state.occupancy(), c.state.alpha})
            append(row, v, ',');
        append(row, c.state.beta, '\n');
        out << row;
    });
    closeWritten(out);
}

}  // namespace akimap::app
