// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "evaluation/octomap_file.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "evaluation/truth.h"

namespace akimap::app {

namespace {

/** Walks the nodes of a .ot: the log-odds, a bit for each child that there is, the children.
 * \return how many there are; 0 if they nest too deep, end early, or hold no number */
uint64_t countNodes(std::istream& in, int depth = 0) {
    float log_odds = 0;
    unsigned char children = 0;
    if (depth > kOctoMapDepth || !in.read(reinterpret_cast<char*>(&log_odds), 4) ||
        !in.read(reinterpret_cast<char*>(&children), 1) || !std::isfinite(log_odds))
        return 0;
    uint64_t nodes = 1;
    for (int i = 0; i < 8; i++)
        if (children >> i & 1) {
            const uint64_t below = countNodes(in, depth + 1);
            if (below == 0) return 0;
            nodes += below;
        }
    return nodes;
}

}  // namespace

OctoMapHeader readOctoMapHeader(std::istream& in, const std::string& first_line) {
    OctoMapHeader header;
    std::string line, key;
    std::getline(in, line);
    if (line.rfind(first_line, 0) != 0) return header;
    while (std::getline(in, line)) {
        std::istringstream words(line);
        if (!(words >> key) || key[0] == '#') continue;
        if (key == "data") return header;
        if (key == "id") words >> header.id;
        if (key == "size") words >> header.size;
        if (key == "res") words >> header.resolution;
    }
    return {};
}

bool isOctoMapFile(const std::string& file) {
    const auto extension = std::filesystem::path(file).extension();
    return extension == ".bt" || extension == ".ot";
}

std::unique_ptr<octomap::OcTree> readOctoMap(const std::string& file) {
    const bool binary = std::filesystem::path(file).extension() == ".bt";
    if (binary) (void)readTruth(file, "the map");
    std::ifstream in(file, std::ios::binary);
    const OctoMapHeader header =
        readOctoMapHeader(in, binary ? "# Octomap OcTree binary file" : "# Octomap OcTree file");
    const auto data = in.tellg();
    if (header.id != "OcTree" || !std::isfinite(header.resolution) || header.resolution <= 0 ||
        (!binary && header.size > 0 && countNodes(in) != header.size))
        throw std::runtime_error("the map '" + file +
                                 "' is missing, damaged or not an OctoMap tree (OcTree)");
    auto tree = std::make_unique<octomap::OcTree>(header.resolution);
    in.clear();
    in.seekg(data);
    if (header.size > 0) binary ? tree->readBinaryData(in) : tree->readData(in);
    return tree;
}

}  // namespace akimap::app
