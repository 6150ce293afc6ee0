// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <akimap/queries.h>

#include <array>
#include <cmath>
#include <iostream>
#include <memory>
#include <stdexcept>

#include "commands/commands.h"
#include "help.h"

namespace akimap::app {

namespace {

struct QueryRequest {
    std::string map;
    std::array<double, 3> point{};  // [m]
};

const char* nameOf(CellKind kind) {
    switch (kind) {
        case CellKind::unknown:
            return "unknown";
        case CellKind::free:
            return "free";
        case CellKind::occupied:
            return "occupied";
        case CellKind::conflicting:
            return "conflicting";
    }
    throw std::logic_error("no such kind of cell");
}

void run(const QueryRequest& request) {
    const auto& [x, y, z] = request.point;
    if (!std::isfinite(x) || !std::isfinite(y) || !std::isfinite(z))
        throw std::runtime_error("X, Y and Z must be finite [m]");
    const auto cell = AkiMap::loadFromFile(request.map)->cell(x, y, z);
    if (cell)
        std::cout << "occupancy " << cell->occupancy() << "  alpha " << cell->alpha << "  beta "
                  << cell->beta << "  variance " << cell->variance() << "  p(occupancy>0.5) "
                  << probabilityAbove(*cell, 0.5) << "  " << nameOf(kindOf(cell)) << "\n";
    else
        std::cout << "unknown\n";
}

}  // namespace

void addQuery(CLI::App& app) {
    auto* command = app.add_subcommand("query", "Print what is known of the cell at a point");
    command->footer(
        "Prints 'unknown', or the occupancy, alpha and beta, the occupancy's variance, the\n"
        "probability that it exceeds 0.5, and free, occupied or conflicting (neither side has "
        "more\n"
        "than three times the other's evidence).");
    const auto request = std::make_shared<QueryRequest>();
    command->add_option("MAP", request->map, "The map (.akimap)")->required();
    const char* const names[] = {"X", "Y", "Z"};
    for (std::size_t i = 0; i < 3; i++)
        command->add_option(names[i], request->point[i], "[m] in the map's frame")
            ->default_str("")
            ->required();
    addExamples(*command, "query drive.akimap 1.0 2.0 0.5", "query drive.akimap -1.0 2.0 0.5");
    command->callback([request] { run(*request); });
}

}  // namespace akimap::app
