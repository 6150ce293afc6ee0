// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <akimap/AkiMap.h>

#include <algorithm>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "commands/commands.h"
#include "estimators/options.h"
#include "grid/BlockGrid.h"
#include "help.h"
#include "mapping/config.h"
#include "pictures/MapCells.h"

namespace akimap::app {

namespace {

struct Contents {
    std::size_t occupied, free, blocks, bytes;
    double unknown;                  // cells without evidence within the bounds
    mrpt::math::TPoint3D low, high;  // bounds [m]
};

Contents contentsOf(const AkiMap& map) {
    const MapCells cells = cellsOf(map, 0.5);
    const CellIndex &low = cells.lowest, &high = cells.highest;
    const double side = map.resolution();
    Contents c{
        cells.occupied.size(), cells.free.size(), map.blockCount(), map.memoryBytes(), 0, {}, {}};
    if (map.isEmpty()) return c;
    c.unknown = (high.x - low.x + 1.0) * (high.y - low.y + 1.0) * (high.z - low.z + 1.0) -
                static_cast<double>(c.occupied + c.free);
    c.low = {low.x * side, low.y * side, low.z * side};
    c.high = {(high.x + 1) * side, (high.y + 1) * side, (high.z + 1) * side};
    return c;
}

/** As they are used at this cell size, without those that the estimator in use does not take. */
std::vector<OptionText> insertionInForce(const AkiMap& map) {
    TInsertionOptions in_force;
    static_cast<InsertionParameters&>(in_force) = map.optionsInForce();
    std::vector<OptionText> options = describe(in_force);
    visitEstimatorOptions(in_force, [&](Estimator estimator, const auto& o, auto&& visitOwn) {
        if (estimator == in_force.estimator) return;
        visitOwn(o, [&](const char* name, const auto&, const char*) {
            options.erase(std::remove_if(options.begin(), options.end(),
                                         [&](const auto& option) { return option.key == name; }),
                          options.end());
        });
    });
    return options;
}

/** A number or a truth value where the text is one. */
nlohmann::json typed(const std::string& text) {
    const auto value = nlohmann::json::parse(text, nullptr, false);
    return value.is_discarded() ? nlohmann::json(text) : value;
}

nlohmann::ordered_json asJson(const std::vector<OptionText>& options) {
    nlohmann::ordered_json json;
    for (const OptionText& option : options) json[option.key] = typed(option.value);
    return json;
}

void printJson(const AkiMap& map, const Contents& c) {
    nlohmann::ordered_json json{{"resolution", map.resolution()},
                                {"cells", c.occupied + c.free},
                                {"cells_occupied", c.occupied},
                                {"cells_free", c.free},
                                {"cells_unknown", c.unknown},
                                {"bounds_min", {c.low.x, c.low.y, c.low.z}},
                                {"bounds_max", {c.high.x, c.high.y, c.high.z}},
                                {"blocks", c.blocks},
                                {"map_bytes", c.bytes},
                                {"insertion", asJson(insertionInForce(map))},
                                {"likelihood", asJson(describe(map.likelihoodOptions))},
                                {"rendering", asJson(describe(map.renderingOptions))}};
    std::cout << json.dump(2) << "\n";
}

template <class Value>
void row(const std::string& name, const Value& value, const std::string& unit = "") {
    std::cout << "  " << name << std::string(name.size() < 22 ? 22 - name.size() : 1, ' ') << value
              << (unit.empty() ? "" : " ") << unit << "\n";
}

void printOptions(const std::string& title, const std::vector<OptionText>& options) {
    std::cout << title << "\n";
    for (const OptionText& option : options) row(option.key, option.value);
}

std::string pointText(const mrpt::math::TPoint3D& p) {
    return mrpt::format("%.3f, %.3f, %.3f", p.x, p.y, p.z);
}

void printText(const AkiMap& map, const Contents& c) {
    std::cout << "contents\n";
    row("resolution", map.resolution(), "m");
    row("cells with evidence", c.occupied + c.free);
    row("occupied (p > 0.5)", c.occupied);
    row("free", c.free);
    row("unknown in bounds", mrpt::format("%.0f", c.unknown));
    row("bounds from", pointText(c.low), "m");
    row("bounds to", pointText(c.high), "m");
    const double cells = static_cast<double>(std::max<std::size_t>(1, c.occupied + c.free));
    row("memory", mrpt::format("%zu bytes in %zu blocks, %.1f a cell", c.bytes, c.blocks,
                               static_cast<double>(c.bytes) / cells));
    printOptions("insertion options in force", insertionInForce(map));
    printOptions("likelihood options", describe(map.likelihoodOptions));
    printOptions("rendering options", describe(map.renderingOptions));
}

}  // namespace

void addInfo(CLI::App& app) {
    struct InfoRequest {
        std::string map;
        bool json = false;
    };
    auto* command = app.add_subcommand(
        "info", "Print a map's contents, bounds, memory and the options in force");
    const auto request = std::make_shared<InfoRequest>();
    command->add_option("MAP", request->map, "The map (.akimap)")->required();
    command->add_flag("--json", request->json, "Print it as JSON");
    addExamples(*command, "info drive.akimap", "info drive.akimap --json > drive.json");
    command->callback([request] {
        const auto map = AkiMap::loadFromFile(request->map);
        (request->json ? printJson : printText)(*map, contentsOf(*map));
    });
}

}  // namespace akimap::app
